// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/experiments/paper_scenes.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// Table II of the paper: how many of the best 20 pre-grasps of a search close to form-closed grasps.
struct Table2Options {
  ModelSource models;
  std::vector<PaperHand> hands{kPaperHands.begin(), kPaperHands.end()};
  std::vector<PaperObject> objects{kPaperObjects.begin(), kPaperObjects.end()};
  int seeds = 5;  ///< runs of each cell, with the seeds 1, 2, ...
  std::int64_t iterations = 70000;
  int grasps = 20;                               ///< pre-grasps that are closed
  int threads = 0;                               ///< 0: all. Does not change the counts
  std::shared_ptr<PreparationCache> cache = {};  ///< of the planner; none: every run prepares anew
  const StopFlag* stop = nullptr;
  /// Called before each run with the share that is done, in [0, 1], and what comes next; may be empty.
  std::function<void(double share, const std::string& next)> progress = {};
  LogSink log = {};  ///< hears what the readers of the models say

  /// All violations as sentences. Empty: the options are sound.
  std::vector<std::string> validate() const;
};

struct Table2Run {
  std::uint64_t seed = 0;
  CandidateCounts candidates;
  PlanTimings timings;
  std::optional<Grasp> best;                ///< the planner's first
  std::vector<SearchMilestone> milestones;  ///< of the search
};

struct Table2Cell {
  PaperHand hand = PaperHand::barrett;
  PaperObject object = PaperObject::ashtray;
  std::vector<Table2Run> runs;

  std::vector<double> form_closed() const;  ///< one a run
  std::vector<double> tested() const;       ///< one a run
};

/// All cells with one search and one friction.
struct Table2Part {
  SearchKind search = SearchKind::paper;
  FrictionCase friction = FrictionCase::materials;
  std::vector<Table2Cell> cells;  ///< hand by hand, in the order of the options

  /// Of the cells' means.
  double mean_form_closed() const;
  const Table2Cell& cell(PaperHand hand, PaperObject object) const;  ///< @pre is there
};

struct Table2 {
  Table2Options options;
  PaperScenes scenes;
  std::vector<Table2Part> parts;  ///< both frictions with the paper's search, then with ours
  bool stopped_early = false;     ///< by the stop flag: cells are missing

  const Table2Part& part(SearchKind search, FrictionCase friction) const;  ///< @pre is there
};

/// Plans 4 x hands x objects x seeds times, one after the other. Cost: 480 runs of the planner by default.
/// @throws Error with the sentences of validate(), or for bad models.
Table2 run_table2(const Table2Options& options);

/// What was aimed at, over all 24 cells with 70,000 iterations and 20 pre-grasps.
struct Table2Target {
  std::string text;      ///< "mu = 1, the paper's search: mean at least 8"
  std::string measured;  ///< "8.3"
  bool met = false;
};
/// Empty where cells are missing or the options are others.
std::vector<Table2Target> check_targets(const Table2& table);

}  // namespace eigengrasp
