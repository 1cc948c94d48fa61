// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>
#include <vector>

#include "planning/candidate_test.hpp"
#include "planning/plan_budget.hpp"

namespace eigengrasp {

/// A pre-grasp and what became of it when the fingers closed.
struct TestedPreGrasp {
  PreGrasp pregrasp;  ///< legal by exact meshes
  CandidateResult result;
  bool palm_moved = false;  ///< up to the object, before the fingers closed
};

/// What a search found.
struct SearchResult {
  std::vector<TestedPreGrasp> kept;  ///< distinct, at most options.grasps
  CandidateCounts candidates;        ///< of those; with children: of all
  int closed_on_the_way = 0;         ///< pre-grasps in all
  StateCounts states;
  std::vector<SearchMilestone> milestones;  ///< of the annealer that found the best state
  double search_seconds = 0.0;              ///< wall time, see PlanTimings
  double anneal_seconds = 0.0;              ///< of drawing and evaluating states
  double close_seconds = 0.0;               ///< of exact legality, closing, contacts, epsilon, exact check
};

/// Section III: one chain of annealing; the best distinct pre-grasps are closed at the end.
SearchResult search_as_the_paper(const Annealer::Task& task, const PlanOptions& options, PlanBudget& budget);

/// Stages of many short chains. After each stage the best pre-grasps that are unlike earlier ones are closed,
/// where they stand or, failing that, after the palm has moved up to the object. Those that close are
/// preferred, and some chains of the next stage begin near them.
SearchResult search_in_stages(const Annealer::Task& task, const PlanOptions& options, PlanBudget& budget);

/// Section V-B: pre-grasps past a threshold are refined by children, in parallel; the chains keep away from
/// there afterwards. Ends with options.grasps distinct form-closed grasps, and keeps no others.
SearchResult search_with_children(const Annealer::Task& task, const PlanOptions& options, PlanBudget& budget);

/// How far apart two pre-grasps of a hand must be.
Distinctness distinctness_of(const HandModel& hand);

/// Whether, and when, the palm moves up to the object before the fingers close.
struct PalmMove {
  double most = 0.0;  ///< [m]; 0: not at all
  /// False: where the pre-grasp does not close to form closure as it stands. True: at once, and as it stands
  /// only where the palm does not come to touch.
  bool first = false;
};

/// Closes one pre-grasp, after making it legal by exact meshes; no test (tests == 0) where it cannot be.
TestedPreGrasp test_pregrasp(const CollisionModel& model, const GraspEnergy& energy, PreGrasp pregrasp,
                             const PalmMove& palm);

/// Closes pre-grasps on all threads, after making them legal by exact meshes; those that cannot be are left
/// out.
std::vector<TestedPreGrasp> test_all(const Annealer::Task& task, std::vector<PreGrasp> pregrasps,
                                     const PlanOptions& options, const PalmMove& palm);

/// Adds up what became of candidates.
void count_outcomes(std::span<const TestedPreGrasp> tested, CandidateCounts& counts);

/// Sums the states of annealers and takes the milestones of the best one.
void summarise_annealers(const std::vector<Annealer>& annealers, SearchResult& result);

}  // namespace eigengrasp
