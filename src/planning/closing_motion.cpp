// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/closing_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

/// Value at which the joint's degree of freedom, or the joint itself, ends in closing direction.
double end_of_travel(const HandJoint& joint, const HandDof& dof) {
  const bool rises = joint.ratio * dof.closing_speed > 0.0;
  const double of_dof = joint.ratio * (dof.closing_speed > 0.0 ? dof.max : dof.min) + joint.offset;
  return rises ? std::min(of_dof, joint.max) : std::max(of_dof, joint.min);
}

}  // namespace

ClosingMotion::ClosingMotion(const HandModel& hand, const Pose& X_OH, const VecX& posture)
    : hand_(hand), joints_(hand.joints.size()), poses_(hand.links.size()) {
  poses_[0].X_OL = X_OH;
  const VecX start = eigengrasp::joint_values(hand, clamp_posture(hand, posture));
  std::vector<double> first_limit(hand.dofs.size(), std::numeric_limits<double>::infinity());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const HandJoint& joint = hand.joints[j];
    Joint& m = joints_[j];
    m.start = start[static_cast<Eigen::Index>(j)];
    if (joint.dof < 0) continue;
    const HandDof& dof = hand.dofs[static_cast<std::size_t>(joint.dof)];
    m.rate = joint.ratio * dof.closing_speed;
    if (m.rate == 0.0) continue;
    m.end = end_of_travel(joint, dof);
    m.limit = m.stop = std::max(0.0, (m.end - m.start) / m.rate);
    double& first = first_limit[static_cast<std::size_t>(joint.dof)];
    first = std::min(first, m.limit);
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const int d = hand.joints[j].dof;
    if (d >= 0 && hand.dofs[static_cast<std::size_t>(d)].type == DofType::rigid)
      joints_[j].stop = std::min(joints_[j].stop, first_limit[static_cast<std::size_t>(d)]);
  }
}

void ClosingMotion::stop(int j, double t) {
  const auto stop_one = [t](Joint& joint) { joint.stop = std::min(joint.stop, t); };
  stop_one(joints_[static_cast<std::size_t>(j)]);
  const int dof = hand_.joints[static_cast<std::size_t>(j)].dof;
  if (dof < 0 || hand_.dofs[static_cast<std::size_t>(dof)].type != DofType::rigid) return;
  for (std::size_t k = 0; k < joints_.size(); ++k)
    if (hand_.joints[k].dof == dof) stop_one(joints_[k]);
}

double ClosingMotion::end() const {
  double end = 0.0;
  for (const Joint& joint : joints_)
    if (joint.rate != 0.0) end = std::max(end, joint.stop);
  return end;
}

double ClosingMotion::fastest() const {
  double fastest = 0.0;
  for (const Joint& joint : joints_) fastest = std::max(fastest, std::abs(joint.rate));
  return fastest;
}

double ClosingMotion::value(const Joint& joint, double t) const {
  if (joint.rate == 0.0) return joint.start;
  const double moved = std::min(t, joint.stop);
  return moved >= joint.limit && joint.limit > 0.0 ? joint.end : joint.start + joint.rate * moved;
}

VecX ClosingMotion::joint_values(double t) const {
  VecX values(static_cast<Eigen::Index>(joints_.size()));
  for (std::size_t j = 0; j < joints_.size(); ++j)
    values[static_cast<Eigen::Index>(j)] = value(joints_[j], t);
  return values;
}

const Pose& ClosingMotion::pose(int link, double t) {
  TimedPose& timed = poses_[static_cast<std::size_t>(link)];
  if (link == 0 || timed.time == t) return timed.X_OL;
  const auto j = static_cast<std::size_t>(link - 1);
  timed.X_OL = link_pose(hand_.joints[j], value(joints_[j], t), pose(hand_.joints[j].parent_link, t));
  timed.time = t;
  return timed.X_OL;
}

}  // namespace eigengrasp
