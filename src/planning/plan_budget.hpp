// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>

#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/planning/annealer.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// Iterations, time and the stop flag: tells the annealers when to end, and reports progress. Shared by all
/// threads.
class PlanBudget {
 public:
  explicit PlanBudget(const PlanOptions& options) : options_(options) {}

  /// Anneals from hot to cold over a number of states. False where the budget ended before.
  bool anneal(Annealer& annealer, std::int64_t states, int worker);

  /// Only a time limit was given, no number of iterations.
  bool repeats() const { return options_.iterations == 0; }
  bool ended() const { return ended_.load(std::memory_order_relaxed); }
  bool ended_early() const {
    return ended() && (!repeats() || (options_.stop && options_.stop->stop_requested()));
  }

 private:
  static constexpr int steps_between_looks = 8;

  bool go_on(int worker, std::int64_t newly_done, const Annealer& annealer);
  void tell_of_milestone(std::int64_t done, const Annealer& annealer);
  double elapsed() const { return watch_.seconds(); }

  const PlanOptions& options_;
  StopWatch watch_;
  std::atomic<std::int64_t> done_{0};
  std::atomic<bool> ended_{false};
  double next_report_ = 0.1;  ///< [s]; used by worker 0 alone
  std::mutex telling_;
  std::atomic<double> told_energy_{std::numeric_limits<double>::infinity()};
};

/// The nth of n_parts nearly equal parts of a whole.
inline std::int64_t part_of(std::int64_t whole, std::size_t n, std::size_t n_parts) {
  const auto parts = static_cast<std::int64_t>(n_parts);
  return whole / parts + (static_cast<std::int64_t>(n) < whole % parts ? 1 : 0);
}

}  // namespace eigengrasp
