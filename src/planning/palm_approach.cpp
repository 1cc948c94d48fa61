// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/palm_approach.hpp"

#include <algorithm>
#include <limits>

#include "eigengrasp/geometry/mesh_motion.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

/// A link and what it may run into.
struct Course {
  int link;
  int obstacle;             ///< -1: the object
  double free_until = 0.0;  ///< travel [m] up to which the two are sure to be apart
  SeparationFront front = {};
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

/// Looks how far the link, posed at X_OL after so much travel, is free to move along the direction.
/// @return the distance [m] of the triangles that limit the way; infinite where none was looked at
double look(const CollisionModel& model, Course& course, const Pose& X_OL, double travel,
            const Vec3& direction_O, double margin) {
  constexpr double look_ahead = 0.010;  // [m]
  constexpr double worth_it = 0.0005;   // [m] that a look at balls must tell
  const Scene& scene = model.scene();
  const bool is_object = course.obstacle < 0;
  const Obstacle* obstacle =
      is_object ? nullptr : &scene.obstacles[static_cast<std::size_t>(course.obstacle)];
  const Pose X_OS = is_object ? Pose::Identity() : obstacle->X_OB;
  const MeshBvh& solid = is_object ? scene.object->bvh : obstacle->model->bvh;
  const auto& link = model.surfaces().links[static_cast<std::size_t>(course.link)];
  const Pose X_SL = X_OS.inverse() * X_OL;
  const Screw screw{Vec3::Zero(), X_OS.linear().transpose() * direction_O};
  const SurfaceMotion motion{{}, {&screw, 1}, 0.0};
  const double way =
      is_object ? link.cover.free_time(model.object_field(), X_SL, motion, margin, look_ahead, worth_it)
                : 0.0;
  if (way >= worth_it) {
    course.free_until = travel + way;
    return std::numeric_limits<double>::infinity();
  }
  const FreeTime free = course.front.look(solid, link.bvh, X_SL, motion, travel, margin, look_ahead,
                                          is_object ? model.object_field() : DistanceField{});
  course.free_until = course.front.free_until();
  return free.distance;
}

}  // namespace

// At unit speed times are lengths. Always the course that is known to be free the shortest way is looked at
// anew.
PalmApproach approach_until_contact(const CollisionModel& model, const Pose& X_OH, const VecX& joints,
                                    double max_travel, double contact_gap) {
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
    const double travel = next.free_until;
    if (travel >= max_travel) break;
    const Pose X = shifted(X_OL[static_cast<std::size_t>(next.link)], travel * direction_O);
    if (look(model, next, X, travel, direction_O, 0.5 * contact_gap) <= contact_gap) {
      result.travel = travel;
      result.touches = true;
      break;
    }
  }
  result.X_OH = shifted(X_OH, result.travel * direction_O);
  return result;
}

}  // namespace eigengrasp
