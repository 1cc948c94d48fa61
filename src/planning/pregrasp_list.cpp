// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/pregrasp_list.hpp"

#include <algorithm>
#include <cmath>

namespace eigengrasp {

double Distinctness::between(const PreGrasp& a, const PreGrasp& b) const {
  const double shift = (a.X_OH * approach_point_H - b.X_OH * approach_point_H).norm() / position;
  if (shift >= 1.0) return shift;
  const double turn = angle_between(a.X_OH.linear(), b.X_OH.linear()) / rotation;
  const double shape = (a.dofs - b.dofs).norm() / posture;
  return std::sqrt(shift * shift + turn * turn + shape * shape);
}

bool PreGraspList::add(PreGrasp candidate) {
  if (!admits(candidate.energy)) return false;
  const auto same = [&](const PreGrasp& other) { return distinct_.between(candidate, other) < 1.0; };
  const auto place = std::find_if(items_.begin(), items_.end(),
                                  [&](const PreGrasp& other) { return candidate.energy < other.energy; });
  if (std::any_of(items_.begin(), place, same)) return false;
  items_.erase(std::remove_if(place, items_.end(), same), items_.end());
  const auto where = std::find_if(items_.begin(), items_.end(),
                                  [&](const PreGrasp& other) { return candidate.energy < other.energy; });
  items_.insert(where, std::move(candidate));
  if (items_.size() > capacity_) items_.pop_back();
  return true;
}

std::optional<PreGrasp> PreGraspList::take_best() {
  if (items_.empty()) return std::nullopt;
  std::optional<PreGrasp> best = std::move(items_.front());
  items_.erase(items_.begin());
  return best;
}

}  // namespace eigengrasp
