// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "eigengrasp/planning/annealer.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// Iterations, time and the stop flag: tells the chains when to end, and reports progress. Shared by all
/// threads.
class PlanBudget {
 public:
  explicit PlanBudget(const PlanOptions& options);

  /// Iterations of one round of a chain; the first chains take one more where they do not divide evenly.
  std::int64_t share_of_chain(std::size_t chain, std::size_t n_chains) const;
  /// Whether another round begins: only where no number of iterations was given.
  bool repeats() const { return options_.iterations == 0; }
  /// Asked before every step. Looks at the clock every 64 steps.
  bool go_on(int worker, const AnnealingChain& chain);
  bool ended_early() const {
    return ended_.load(std::memory_order_relaxed) &&
           (!repeats() || (options_.stop && options_.stop->stop_requested()));
  }

 private:
  static constexpr std::int64_t steps_between_looks = 64;
  static constexpr std::int64_t round_length = 20000;  ///< of a chain, where only a time limit is given

  double elapsed() const;

  const PlanOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<std::int64_t> done_{0};
  std::atomic<bool> ended_{false};
  double next_report_ = 0.1;  ///< [s]; used by worker 0 alone
};

}  // namespace eigengrasp
