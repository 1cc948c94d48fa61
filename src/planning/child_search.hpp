// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>

#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

/// What became of a pre-grasp that was handed to a child.
struct ChildResult {
  TestedPreGrasp tested;  ///< the form-closed one, else the first that was tested; tests == 0: none could be
  StateCounts states;     ///< of the local search
  int tests = 0;          ///< pre-grasps that were closed
};

/// Energy of eq. (8) of a pre-grasp, from the object's field.
double compute_wrench_energy(const CollisionModel& model, const GraspEnergy& energy,
                             const PreGrasp& pregrasp);

/// Section V-B: develops a pre-grasp into form closure. It is closed where it stands, then after the palm has
/// moved up to the object; where neither holds, a short annealing with fine steps about it looks for better
/// states, and the one of the lowest energy by eq. (8) is closed. Pre-grasps stay in the searched eigengrasp
/// space.
class ChildSearch {
 public:
  /// What it refers to must outlive it.
  ChildSearch(const Annealer::Task& parent, PlanBudget& budget) : parent_(parent), budget_(budget) {}

  /// @param number of the child: with the seed the key of its random streams @param anneals where closing
  /// fails. Any number of children may be raised at once.
  ChildResult refine(const PreGrasp& pregrasp, std::uint64_t number, bool anneals, int worker) const;

 private:
  std::optional<PreGrasp> search_about(const PreGrasp& pregrasp, std::uint64_t number, int worker,
                                       StateCounts& counts) const;

  const Annealer::Task& parent_;
  PlanBudget& budget_;
};

}  // namespace eigengrasp
