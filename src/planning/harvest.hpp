// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

/// All pre-grasps that a search in stages has closed, and which of them are worth keeping.
class Harvest {
 public:
  Harvest(const Annealer::Task& task, const PlanOptions& options);

  /// Closes the best pre-grasps of the annealers' lists that are unlike all that were closed before.
  void gather(std::vector<Annealer>& annealers, std::size_t most);

  /// Those that close to form closure.
  std::size_t n_closed() const { return closed_.size(); }
  /// One of them, the better ones (by epsilon) more likely. @param u uniform in [0, 1) @pre n_closed() > 0
  const PreGrasp& draw_closed(double u) const;

  /// At most options.grasps distinct pre-grasps: those that close by falling epsilon, then by rising energy.
  std::vector<TestedPreGrasp> best() const;
  const std::vector<TestedPreGrasp>& all() const { return tested_; }

 private:
  bool is_new(const PreGrasp& p) const;
  PalmMove palm_move() const;
  void count(const TestedPreGrasp& tested, bool palm_first);

  const Annealer::Task& task_;
  const PlanOptions& options_;
  Distinctness distinct_;
  std::vector<PreGrasp> seen_;  ///< as they came from the annealers
  std::vector<TestedPreGrasp> tested_;
  std::vector<std::size_t> closed_;  ///< of tested_, by falling epsilon
  /// How many pre-grasps were closed in a way, and how many of them to form closure.
  struct Tally {
    int tried = 0;
    int closed = 0;
    double share() const { return tried > 0 ? static_cast<double>(closed) / tried : 0.0; }
  };
  Tally in_place_, after_move_;
};

}  // namespace eigengrasp
