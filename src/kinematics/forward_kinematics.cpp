// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/kinematics/forward_kinematics.hpp"

#include <limits>

namespace eigengrasp {

namespace {

/// Rotation about a unit axis (Rodrigues).
Mat3 rotation_about(const Vec3& a, double angle) {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const Vec3 t = (1.0 - c) * a;
  Mat3 R;
  R << t.x() * a.x() + c, t.x() * a.y() - s * a.z(), t.x() * a.z() + s * a.y(),  //
      t.x() * a.y() + s * a.z(), t.y() * a.y() + c, t.y() * a.z() - s * a.x(),   //
      t.x() * a.z() - s * a.y(), t.y() * a.z() + s * a.x(), t.z() * a.z() + c;
  return R;
}

}  // namespace

VecX clamp_posture(const HandModel& hand, const VecX& posture) {
  VecX clamped(posture.size());
  for (Eigen::Index d = 0; d < posture.size(); ++d) {
    const HandDof& dof = hand.dofs[static_cast<std::size_t>(d)];
    clamped[d] = std::min(dof.max, std::max(dof.min, posture[d]));
  }
  return clamped;
}

VecX joint_values(const HandModel& hand, const VecX& posture) {
  VecX values = VecX::Zero(hand.n_joints());
  for (int j = 0; j < hand.n_joints(); ++j) {
    const HandJoint& joint = hand.joints[static_cast<std::size_t>(j)];
    if (joint.dof >= 0) values[j] = joint.ratio * posture[joint.dof] + joint.offset;
  }
  return values;
}

VecX posture_of_joints(const HandModel& hand, const VecX& joints) {
  VecX posture = hand.rest_posture();
  std::vector<double> furthest(hand.dofs.size(), -std::numeric_limits<double>::infinity());
  for (int j = 0; j < hand.n_joints(); ++j) {
    const HandJoint& joint = hand.joints[static_cast<std::size_t>(j)];
    if (joint.dof < 0 || joint.ratio == 0.0) continue;
    const auto d = static_cast<std::size_t>(joint.dof);
    const double value = (joints[j] - joint.offset) / joint.ratio;
    const double progress = hand.dofs[d].closing_speed < 0.0 ? -value : value;
    if (progress > furthest[d]) {
      furthest[d] = progress;
      posture[joint.dof] = value;
    }
  }
  return posture;
}

Pose link_pose(const HandJoint& joint, double value, const Pose& X_OP) {
  Pose X = X_OP * joint.X_PJ;
  if (joint.type == JointType::revolute) {
    X.linear() = (X.linear() * rotation_about(joint.axis_J, value)).eval();
  } else if (joint.type == JointType::prismatic) {
    X.translation() += X.linear() * (value * joint.axis_J);
  }
  return X;
}

void compute_link_poses(const HandModel& hand, const VecX& joints, const Pose& X_OH,
                        std::vector<Pose>& X_OL) {
  X_OL.resize(hand.links.size());
  X_OL[0] = X_OH;
  for (std::size_t j = 0; j < hand.joints.size(); ++j) {
    const HandJoint& joint = hand.joints[j];
    X_OL[j + 1] = link_pose(joint, joints[static_cast<Eigen::Index>(j)],
                            X_OL[static_cast<std::size_t>(joint.parent_link)]);
  }
}

bool moves_link(const HandModel& hand, int j, int link) {
  if (hand.joints[static_cast<std::size_t>(j)].type == JointType::fixed) return false;
  while (link > j + 1) link = hand.joints[static_cast<std::size_t>(link - 1)].parent_link;
  return link == j + 1;
}

Vec3 point_velocity(const HandModel& hand, const std::vector<Pose>& X_OL, int link, int j, const Vec3& p_O) {
  if (!moves_link(hand, j, link)) return Vec3::Zero();
  const HandJoint& joint = hand.joints[static_cast<std::size_t>(j)];
  // The joint's own motion leaves its axis and, for a rotation, its origin where they are.
  const Pose& X_OJ = X_OL[static_cast<std::size_t>(j + 1)];
  const Vec3 axis_O = X_OJ.linear() * joint.axis_J;
  if (joint.type == JointType::prismatic) return axis_O;
  return axis_O.cross(p_O - X_OJ.translation());
}

}  // namespace eigengrasp
