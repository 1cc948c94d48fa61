// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/pregrasp_list.hpp"

#include <cmath>

namespace eigengrasp {

double Distinctness::between(const PreGrasp& a, const PreGrasp& b) const {
  const double shift = (a.X_OH * approach_point_H - b.X_OH * approach_point_H).norm() / position;
  if (shift >= 1.0) return shift;
  const double turn = angle_between(a.X_OH.linear(), b.X_OH.linear()) / rotation;
  const double shape = (a.dofs - b.dofs).norm() / posture;
  return std::sqrt(shift * shift + turn * turn + shape * shape);
}

bool PreGraspList::same(const PreGrasp& p, const Vec3& place, std::size_t item) const {
  const double shift = (place - places_[item]).squaredNorm() / (distinct_.position * distinct_.position);
  if (shift >= 1.0) return false;
  const PreGrasp& other = items_[item];
  const double shape = (p.dofs - other.dofs).squaredNorm() / (distinct_.posture * distinct_.posture);
  if (shift + shape >= 1.0) return false;
  const double turn = angle_between(p.X_OH.linear(), other.X_OH.linear()) / distinct_.rotation;
  return shift + shape + turn * turn < 1.0;
}

bool PreGraspList::add(PreGrasp candidate) {
  if (!admits(candidate.energy)) return false;
  const Vec3 place = candidate.X_OH * distinct_.approach_point_H;
  std::size_t rank = 0;
  for (; rank < items_.size() && !(candidate.energy < items_[rank].energy); ++rank)
    if (same(candidate, place, rank)) return false;
  std::size_t kept = rank;
  for (std::size_t i = rank; i < items_.size(); ++i) {
    if (same(candidate, place, i)) continue;
    if (kept != i) {
      items_[kept] = std::move(items_[i]);
      places_[kept] = places_[i];
    }
    ++kept;
  }
  items_.resize(kept);
  places_.resize(kept);
  items_.insert(items_.begin() + static_cast<std::ptrdiff_t>(rank), std::move(candidate));
  places_.insert(places_.begin() + static_cast<std::ptrdiff_t>(rank), place);
  if (items_.size() > capacity_) {
    items_.pop_back();
    places_.pop_back();
  }
  return true;
}

std::optional<PreGrasp> PreGraspList::take_best() {
  if (items_.empty()) return std::nullopt;
  std::optional<PreGrasp> best = std::move(items_.front());
  items_.erase(items_.begin());
  places_.erase(places_.begin());
  return best;
}

void PreGraspList::clear() {
  items_.clear();
  places_.clear();
}

}  // namespace eigengrasp
