// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/palm_approach.hpp"

#include <algorithm>

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

/// A link and what it may run into.
struct Course {
  int link;
  int obstacle;           ///< -1: the object
  double free_until = 0;  ///< travel [m] up to which the two are known to be apart
  PairHint hint = {};
};

std::vector<Course> list_courses(const CollisionModel& model) {
  std::vector<Course> courses;
  const int n_obstacles = static_cast<int>(model.scene().obstacles.size());
  for (int i = 0; i < model.scene().hand->n_links(); ++i) {
    if (model.surfaces().links[static_cast<std::size_t>(i)].empty()) continue;
    for (int k = -1; k < n_obstacles; ++k) courses.push_back({i, k});
  }
  return courses;
}

Pose shifted(const Pose& X, const Vec3& by) {
  Pose moved = X;
  moved.translation() += by;
  return moved;
}

}  // namespace

// Every point moves as far as the hand does, so that a distance is also a free travel. Always the course that
// is known to be free the shortest way is looked at anew.
PalmApproach approach_until_contact(const CollisionModel& model, const Pose& X_OH, const VecX& joints,
                                    double max_travel, double contact_gap) {
  constexpr double exact_below = 0.010;  // [m]
  const HandModel& hand = *model.scene().hand;
  const Vec3 direction_O = X_OH.linear() * hand.approach_direction_H;
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joints, X_OH, X_OL);
  std::vector<Course> courses = list_courses(model);
  PalmApproach result;
  result.travel = max_travel;
  while (!courses.empty()) {
    Course& next = *std::min_element(courses.begin(), courses.end(), [](const Course& a, const Course& b) {
      return a.free_until < b.free_until;
    });
    if (next.free_until >= max_travel) break;
    const Pose X = shifted(X_OL[static_cast<std::size_t>(next.link)], next.free_until * direction_O);
    const double distance =
        next.obstacle < 0 ? model.distance_to_object(next.link, X, exact_below, &next.hint)
                          : model.distance_to_obstacle(next.obstacle, next.link, X, exact_below, &next.hint);
    if (distance <= contact_gap) {
      result.travel = next.free_until;
      result.touches = true;
      break;
    }
    next.free_until += distance - 0.5 * contact_gap;
  }
  result.X_OH = shifted(X_OH, result.travel * direction_O);
  return result;
}

}  // namespace eigengrasp
