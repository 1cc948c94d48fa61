// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <fmt/format.h>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp::testing {

inline Vec3 random_unit(RandomStream& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

inline Pose random_pose(RandomStream& random, double reach) {
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  return make_pose(q, reach * random_unit(random));
}

/// A random tree of fixed, revolute and prismatic joints; some share a degree of freedom through couplings.
inline HandModel random_hand(std::uint64_t seed, int n_joints) {
  RandomStream random{seed};
  HandModel hand;
  hand.name = "random";
  hand.links.push_back({.name = "base", .mesh = {}, .material = {}, .mass = 0.0});
  for (int j = 0; j < n_joints; ++j) {
    HandJoint joint;
    joint.name = fmt::format("j{}", j);
    joint.parent_link = static_cast<int>(random.uniform(0.0, j + 1.0));
    joint.X_PJ = random_pose(random, 0.05);
    joint.axis_J = random_unit(random);
    const double kind = random.uniform();
    joint.type = kind < 0.1 ? JointType::fixed : kind < 0.3 ? JointType::prismatic : JointType::revolute;
    if (joint.type != JointType::fixed) {
      const bool couple = hand.n_dof() > 0 && random.uniform() < 0.3;
      joint.dof = couple ? static_cast<int>(random.uniform(0.0, hand.n_dof())) : hand.n_dof();
      if (!couple) {
        hand.dofs.push_back({fmt::format("d{}", joint.dof), DofType::rigid, -1.0, 1.0, 0.1,
                             random.uniform() < 0.5 ? 1.0 : -1.0});
      }
      joint.ratio = couple ? random.uniform(0.2, 1.5) : 1.0;
      joint.offset = couple ? random.uniform(-0.2, 0.2) : 0.0;
      joint.min = -2.0;
      joint.max = 2.0;
    }
    hand.joints.push_back(joint);
    hand.links.push_back({.name = fmt::format("l{}", j + 1), .mesh = {}, .material = {}, .mass = 0.0});
  }
  hand.eigengrasps =
      EigengraspSpace::identity(VecX::Zero(hand.n_dof()), hand.dof_min(), hand.dof_max(), hand.dof_names());
  return hand;
}

}  // namespace eigengrasp::testing
