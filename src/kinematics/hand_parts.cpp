// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/kinematics/hand_parts.hpp"

#include <cmath>

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

std::vector<int> finger_roots(const HandModel& hand) {
  std::vector<std::vector<int>> children(hand.links.size());
  for (std::size_t j = 0; j < hand.joints.size(); ++j)
    children[static_cast<std::size_t>(hand.joints[j].parent_link)].push_back(static_cast<int>(j) + 1);
  std::vector<int> roots(hand.links.size(), -1);
  std::size_t palm = 0;
  while (children[palm].size() == 1) palm = static_cast<std::size_t>(children[palm].front());
  for (std::size_t j = 0; j < hand.joints.size(); ++j) {
    const auto parent = static_cast<std::size_t>(hand.joints[j].parent_link);
    if (parent == palm)
      roots[j + 1] = static_cast<int>(j) + 1;
    else
      roots[j + 1] = roots[parent];
  }
  return roots;
}

namespace {

Vec3 across(const Vec3& v, const Vec3& axis) {
  return v - v.dot(axis) * axis;
}

/// Not of unit length; zero where no virtual contact is off the axis.
Vec3 reaching_direction(const HandModel& hand) {
  constexpr double on_axis = 0.010;  // [m]
  std::vector<Pose> X_HL;
  compute_link_poses(hand, joint_values(hand, hand.rest_posture()), Pose::Identity(), X_HL);
  Vec3 sum = Vec3::Zero(), farthest = Vec3::Zero();
  for (const VirtualContact& c : hand.virtual_contacts) {
    const Vec3 p = X_HL[static_cast<std::size_t>(c.link)] * c.p_LC - hand.approach_point_H;
    const Vec3 side = across(p, hand.approach_direction_H);
    sum += side;
    if (side.norm() > farthest.norm()) farthest = side;
  }
  return sum.norm() >= on_axis * static_cast<double>(hand.virtual_contacts.size()) ? sum : farthest;
}

}  // namespace

Pose approach_frame(const HandModel& hand) {
  const Vec3 z = hand.approach_direction_H;
  Vec3 x = reaching_direction(hand);
  if (x.norm() < 1e-6) x = Vec3::Unit(std::abs(z.x()) < 0.9 ? 0 : 1);
  x = across(x, z).normalized();
  Pose X_HA = Pose::Identity();
  X_HA.linear().col(0) = x;
  X_HA.linear().col(1) = z.cross(x);
  X_HA.linear().col(2) = z;
  X_HA.translation() = hand.approach_point_H;
  return X_HA;
}

}  // namespace eigengrasp
