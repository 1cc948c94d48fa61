// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/harvest.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace eigengrasp {

namespace {
constexpr double palm_travel = 0.030;  ///< [m] the palm may move up to the object before the fingers close
}

Harvest::Harvest(const Annealer::Task& task, const PlanOptions& options)
    : task_(task), options_(options), distinct_(distinctness_of(*task.model.scene().hand)) {}

bool Harvest::is_new(const PreGrasp& p) const {
  return std::none_of(seen_.begin(), seen_.end(),
                      [&](const PreGrasp& other) { return distinct_.between(p, other) < 1.0; });
}

void Harvest::gather(std::vector<Annealer>& annealers, std::size_t most) {
  std::vector<PreGrasp> pool;
  for (Annealer& a : annealers) {
    const std::vector<PreGrasp>& best = a.best().items();
    pool.insert(pool.end(), best.begin(), best.end());
  }
  std::stable_sort(pool.begin(), pool.end(),
                   [](const PreGrasp& a, const PreGrasp& b) { return a.energy < b.energy; });
  const std::size_t n_seen = seen_.size();
  for (const PreGrasp& p : pool) {
    if (seen_.size() == n_seen + most) break;
    if (is_new(p)) seen_.push_back(p);
  }
  std::vector<PreGrasp> chosen(seen_.begin() + static_cast<std::ptrdiff_t>(n_seen), seen_.end());
  const PalmMove palm = palm_move();
  for (TestedPreGrasp& t : test_all(task_, std::move(chosen), options_, palm)) {
    count(t, palm.first);
    if (t.result.grasp.form_closure) closed_.push_back(tested_.size());
    tested_.push_back(std::move(t));
  }
  std::stable_sort(closed_.begin(), closed_.end(), [&](std::size_t a, std::size_t b) {
    return tested_[a].result.grasp.epsilon > tested_[b].result.grasp.epsilon;
  });
}

/// A hand that seldom closes where it stands, as one of three fingers, need not be closed twice.
PalmMove Harvest::palm_move() const {
  return {palm_travel, after_move_.share() > 2.0 * in_place_.share()};
}

void Harvest::count(const TestedPreGrasp& tested, bool palm_first) {
  const bool closes = tested.result.grasp.form_closure;
  const bool closes_in_place = closes && !tested.palm_moved;
  if (!palm_first || !tested.palm_moved) {
    ++in_place_.tried;
    in_place_.closed += closes_in_place ? 1 : 0;
  }
  if (tested.palm_moved || (!palm_first && !closes_in_place)) {
    ++after_move_.tried;
    after_move_.closed += closes && tested.palm_moved ? 1 : 0;
  }
}

const PreGrasp& Harvest::draw_closed(double u) const {
  // u^2: the better half is drawn in 71 of 100 cases.
  const auto place = static_cast<std::size_t>(u * u * static_cast<double>(closed_.size()));
  return tested_[closed_[place]].pregrasp;
}

std::vector<TestedPreGrasp> Harvest::best() const {
  std::vector<std::size_t> order = closed_;
  for (std::size_t i = 0; i < tested_.size(); ++i)
    if (!tested_[i].result.grasp.form_closure) order.push_back(i);
  std::stable_sort(
      order.begin() + static_cast<std::ptrdiff_t>(closed_.size()), order.end(),
      [&](std::size_t a, std::size_t b) { return tested_[a].pregrasp.energy < tested_[b].pregrasp.energy; });
  std::vector<TestedPreGrasp> kept;
  for (const std::size_t i : order) {
    if (kept.size() == static_cast<std::size_t>(options_.grasps)) break;
    const bool distinct = std::none_of(kept.begin(), kept.end(), [&](const TestedPreGrasp& k) {
      return distinct_.between(k.pregrasp, tested_[i].pregrasp) < 1.0;
    });
    if (distinct) kept.push_back(tested_[i]);
  }
  return kept;
}

}  // namespace eigengrasp
