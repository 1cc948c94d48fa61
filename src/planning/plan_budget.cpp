// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/plan_budget.hpp"

namespace eigengrasp {

bool PlanBudget::anneal(Annealer& annealer, std::int64_t states, int worker) {
  const std::int64_t first = annealer.iterations();
  std::int64_t done = 0;
  while (done < states) {
    const std::int64_t before = done;
    for (int i = 0; i < steps_between_looks && done < states; ++i) {
      annealer.step(static_cast<double>(done) / static_cast<double>(states), states - done);
      done = annealer.iterations() - first;
    }
    if (!go_on(worker, done - before, annealer)) return false;
  }
  return true;
}

bool PlanBudget::go_on(int worker, std::int64_t newly_done, const Annealer& annealer) {
  if (ended()) return false;
  const std::int64_t done = done_.fetch_add(newly_done, std::memory_order_relaxed) + newly_done;
  const bool stop = options_.stop && options_.stop->stop_requested();
  const double now = elapsed();
  if (stop || (options_.time_limit > 0.0 && now > options_.time_limit)) {
    ended_.store(true, std::memory_order_relaxed);
    return false;
  }
  if (options_.milestone) tell_of_milestone(done, annealer);
  if (worker == 0 && options_.progress && now > next_report_) {
    next_report_ = now + 0.1;
    const double best = annealer.milestones().empty() ? 0.0 : annealer.best_energy();
    options_.progress({done, options_.iterations, now, best});
  }
  return true;
}

void PlanBudget::tell_of_milestone(std::int64_t done, const Annealer& annealer) {
  if (annealer.milestones().empty()) return;
  const SearchMilestone& last = annealer.milestones().back();
  if (last.energy >= told_energy_.load(std::memory_order_relaxed)) return;
  const std::lock_guard lock(telling_);
  if (last.energy >= told_energy_.load(std::memory_order_relaxed)) return;
  told_energy_.store(last.energy, std::memory_order_relaxed);
  options_.milestone({done, last.energy, last.X_OH, last.dofs});
}

}  // namespace eigengrasp
