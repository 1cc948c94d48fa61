// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/experiments/machine.hpp"
#include "eigengrasp/experiments/paper_scenes.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

struct PerformanceOptions {
  double seconds = 1.0;  ///< each rate is measured for about as long, but at least once
  int threads = 0;       ///< "all"; one thread is always measured
  SearchKind search = SearchKind::staged;
  std::int64_t iterations = 70000;  ///< of a run
  const StopFlag* stop = nullptr;
};

/// Steps of testing one candidate [s]: means over the tested pre-grasps, medians over the repetitions; one
/// thread.
struct CandidateSteps {
  double close = 0.0;     ///< close_fingers
  double contacts = 0.0;  ///< find_contacts
  double closure = 0.0;   ///< has_form_closure
  double epsilon = 0.0;   ///< compute_epsilon, which decides closure too
};

/// What depends on the number of threads; medians over the runs or repetitions.
struct ThreadedPerformance {
  int threads = 1;
  double prepare = 0.0;                ///< [s] of a run, all made anew
  double prepare_object = 0.0;         ///< [s] of the object alone, anew
  double prepare_cached = 0.0;         ///< [s] with fields and spheres from the cache on disk
  double run = 0.0;                    ///< [s] search, closing, rating and check, without preparation
  double paper_run = 0.0;              ///< [s] the same of the paper's search, which closes the best alone
  double states_per_second = 0.0;      ///< of the search: drawn, tested, and rated where legal
  double candidates_per_second = 0.0;  ///< closed, contacts found, epsilon
};

/// How fast the planner is for a hand and an object.
struct ScenePerformance {
  std::string hand;
  std::string object;
  std::optional<PaperHand> paper_hand;  ///< where there are figures of GraspIt! to compare with
  std::int64_t triangles = 0;           ///< of the object
  int runs = 0;                         ///< of the planner, on one thread; as many seeds
  double legal_share = 0.0;             ///< of the states of the search, all of them judged
  double judged_per_second = 0.0;       ///< as states_per_second on one thread, with PlanOptions::judge_all
  int candidates = 0;                   ///< pre-grasps of the first run
  int closed_on_the_way = 0;            ///< pre-grasps in the first run, of which those are the best
  double contacts = 0.0;                ///< mean of a closed candidate
  CandidateSteps steps;
  std::vector<ThreadedPerformance> by_threads;  ///< one thread, then all
  std::int64_t peak_memory = 0;  ///< [bytes] of the process in a run on all threads; 0: unknown
};

/// Runs the planner with the seeds 1, 2, ... (the first without a cache, the others with one in a temporary
/// folder) and measures; the states are those that its search draws, the
/// candidates the pre-grasps that it finds. Runs on one thread and on all take turns, so that what else the
/// machine does hits both. A stop flag ends it early: what was measured until then counts.
/// @throws Error where the planner's options do not suit the hand
ScenePerformance measure_performance(const Scene& scene, const PerformanceOptions& options);

/// Speed of the wrench space alone, of 8 point contacts with 8 edges on an ellipsoid the size of a hand [s],
/// means over 64 random sets, one thread; medians of repetitions.
struct WrenchPerformance {
  double epsilon = 0.0;
  double closure = 0.0;
};
WrenchPerformance measure_wrench_space(double seconds);

/// A measurement of several scenes with its circumstances.
struct PerformanceReport {
  ExperimentRecord record;
  PerformanceOptions options;
  WrenchPerformance wrench;
  std::vector<ScenePerformance> scenes;
};

/// Lines for a terminal, of one scene.
std::string performance_text(const ScenePerformance& scene);
std::string performance_json(const PerformanceReport& report);
/// A page: the figures of all scenes, and what was aimed at beside GraspIt!'s figures.
std::string performance_markdown(const PerformanceReport& report);

}  // namespace eigengrasp
