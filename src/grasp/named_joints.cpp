// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/grasp/named_joints.hpp"

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

VecX joints_by_name(const HandModel& hand, const NamedValues& values) {
  VecX joints = joint_values(hand, hand.rest_posture());
  for (const auto& [name, value] : values) {
    const int j = hand.find_joint(name);
    if (j < 0) fail("the hand \"{}\" has no joint \"{}\"", hand.name, name);
    joints[j] = value;
  }
  return joints;
}

NamedValues named_joints(const HandModel& hand, const VecX& joints) {
  NamedValues named;
  for (int j = 0; j < hand.n_joints(); ++j) {
    const HandJoint& joint = hand.joints[static_cast<std::size_t>(j)];
    if (joint.type != JointType::fixed) named.emplace_back(joint.name, joints[j]);
  }
  return named;
}

}  // namespace eigengrasp
