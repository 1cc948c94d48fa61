// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/plan_budget.hpp"

namespace eigengrasp {

PlanBudget::PlanBudget(const PlanOptions& options) : options_(options) {}

std::int64_t PlanBudget::share_of_chain(std::size_t chain, std::size_t n_chains) const {
  if (repeats()) return round_length;
  const auto n = static_cast<std::int64_t>(n_chains);
  return options_.iterations / n + (static_cast<std::int64_t>(chain) < options_.iterations % n ? 1 : 0);
}

double PlanBudget::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool PlanBudget::go_on(int worker, const AnnealingChain& chain) {
  if (chain.iterations() % steps_between_looks != 0) return true;
  if (ended_.load(std::memory_order_relaxed)) return false;
  const std::int64_t done = done_.fetch_add(steps_between_looks, std::memory_order_relaxed);
  const bool stop = options_.stop && options_.stop->stop_requested();
  if (stop || (options_.time_limit > 0.0 && elapsed() > options_.time_limit)) {
    ended_.store(true, std::memory_order_relaxed);
    return false;
  }
  if (worker == 0 && options_.progress && elapsed() > next_report_) {
    next_report_ = elapsed() + 0.1;
    const auto& best = chain.best().items();
    options_.progress({done, options_.iterations, elapsed(), best.empty() ? 0.0 : best.front().energy});
  }
  return true;
}

}  // namespace eigengrasp
