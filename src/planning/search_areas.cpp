// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/search_areas.hpp"

#include <algorithm>

namespace eigengrasp {

void SearchAreas::add(const PreGrasp& center) {
  centers_.push_back(center);
  places_.push_back(center.X_OH * size_.approach_point_H);
}

bool SearchAreas::holds(const PreGrasp& pregrasp) const {
  return std::any_of(centers_.begin(), centers_.end(),
                     [&](const PreGrasp& center) { return size_.between(center, pregrasp) < 1.0; });
}

bool SearchAreas::holds(const HandState& state) const {
  const double reach = size_.position * size_.position;
  for (std::size_t i = 0; i < centers_.size(); ++i) {
    if ((places_[i] - state.p_OA).squaredNorm() >= reach) continue;
    PreGrasp p;
    p.X_OH = hand_pose(hand_, state);
    p.dofs = hand_posture(hand_, space_, state);
    if (size_.between(centers_[i], p) < 1.0) return true;
  }
  return false;
}

}  // namespace eigengrasp
