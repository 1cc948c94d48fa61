// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/grasp/scene.hpp"

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

Obstacle make_table(double z) {
  constexpr double half_side = 1.0;
  constexpr double thickness = 0.05;
  TriangleMesh box;
  for (int corner = 0; corner < 8; ++corner)
    box.vertices.emplace_back((corner & 1) ? half_side : -half_side, (corner & 2) ? half_side : -half_side,
                              (corner & 4) ? z : z - thickness);
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return {std::make_shared<ObjectModel>(make_object("table", std::move(box))), Pose::Identity()};
}

void set_friction(Scene& scene, double friction) {
  HandModel hand = *scene.hand;
  for (HandLink& link : hand.links) link.material.friction = friction;
  scene.hand = std::make_shared<HandModel>(std::move(hand));
}

double hand_reach(const HandModel& hand) {
  std::vector<Pose> X_HL;
  compute_link_poses(hand, joint_values(hand, hand.rest_posture()), Pose::Identity(), X_HL);
  double reach = 0.0;
  for (std::size_t i = 0; i < hand.links.size(); ++i)
    for (const Vec3& v : hand.links[i].mesh.vertices) reach = std::max(reach, (X_HL[i] * v).norm());
  return reach;
}

}  // namespace eigengrasp
