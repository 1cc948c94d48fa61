// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "online/shown_hand.hpp"

#include <algorithm>

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

constexpr double finger_speed = 4.0;       // [rad/s or m/s], of a degree of freedom
constexpr double still = 0.0025;           // [m] less than that from where the hand is shown is tremor
constexpr double settling = 0.15;          // [s] in which tremor is averaged
constexpr double turn_as_distance = 0.10;  // [m/rad] a turn that is to come counts as that much way
constexpr double full_preshape = 0.02;     // [m] the posture is reached that much before the pre-grasp
constexpr int halvings = 3;                // of a way that is not free as a whole
constexpr double start_step = 0.01;        // [m] by which a hand that starts in collision is drawn back
constexpr int most_start_steps = 40;

Pose between(const Pose& a, const Pose& b, double share) {
  const Eigen::Quaterniond q = orientation(a).slerp(share, orientation(b));
  return make_pose(q, (1.0 - share) * a.translation() + share * b.translation());
}

}  // namespace

ShownHand::ShownHand(const CollisionModel& model, const OnlineOptions& options)
    : model_(model),
      options_(options),
      open_(clamp_posture(*model.scene().hand, model.scene().hand->rest_posture())),
      dofs_(open_) {}

VecX ShownHand::joints() const {
  return joints_.size() > 0 ? joints_ : joint_values(*model_.scene().hand, dofs_);
}

bool ShownHand::is_free(const Pose& X_OH, const VecX& dofs) {
  const HandModel& hand = *model_.scene().hand;
  compute_link_poses(hand, joint_values(hand, dofs), X_OH, X_OL_);
  return model_.check_exact(X_OL_) == Legality::legal;
}

/// The wrist as held, but for what is tremor or the tracker's noise: that is averaged, the more the less the
/// hand moves.
Pose ShownHand::steady(const Pose& X_OW, double seconds) const {
  const double way = (X_OW.translation() - steady_.translation()).norm() +
                     turn_as_distance * angle_between(X_OW.linear(), steady_.linear());
  if (way >= still) return X_OW;
  const double lag = settling * (1.0 - way / still);
  return between(steady_, X_OW, seconds / (seconds + lag));
}

/// Draws a hand that begins inside something back until it is free.
bool ShownHand::find_free_start(const Pose& X_OW) {
  for (int i = 0; i < most_start_steps; ++i) {
    const Vec3 back = -i * start_step * model_.scene().hand->approach_direction_H;
    const Pose X_OH = X_OW * Eigen::Translation3d(back);
    if (!is_free(X_OH, dofs_)) continue;
    X_OH_ = X_OH;
    blocked_ = i > 0;
    return true;
  }
  return false;
}

/// The posture after some time of moving towards another.
VecX ShownHand::towards(const VecX& wanted, double seconds) const {
  const double most = finger_speed * seconds;
  return dofs_ + (wanted - dofs_).cwiseMax(-most).cwiseMin(most);
}

/// Moves the wrist as far towards where it is held as the fingers allow.
void ShownHand::go_as_far_as_free(const Pose& X_OW) {
  const Pose from = X_OH_;
  double share = 0.5;
  for (double half = 0.25; half > 1.0 / (1 << (halvings + 1)); half *= 0.5) {
    const Pose X_OH = between(from, X_OW, share);
    const bool free = is_free(X_OH, dofs_);
    if (free) X_OH_ = X_OH;
    share += free ? half : -half;
  }
}

void ShownHand::follow(const Pose& X_OW_held, const Grasp* offered, double seconds) {
  const Pose X_OW = steady_ = placed_ ? steady(X_OW_held, seconds) : X_OW_held;
  joints_.resize(0);
  double wanted = 0.0;
  if (offered) {
    const Pose& X_OP = offered->X_OH_pregrasp;
    const double way = (X_OP.translation() - X_OW.translation()).norm() +
                       turn_as_distance * angle_between(X_OP.linear(), X_OW.linear());
    const double span = std::max(options_.preshape_begins - full_preshape, 1e-6);
    wanted = std::clamp((options_.preshape_begins - way) / span, 0.0, 1.0);
  }
  preshape_ = wanted;
  if (!placed_) {
    placed_ = find_free_start(X_OW);
    if (!placed_) {
      blocked_ = true;
      return;
    }
  }
  const VecX goal = offered ? VecX(open_ + wanted * (offered->pregrasp_dofs - open_)) : open_;
  const VecX moved = towards(goal, seconds);
  blocked_ = false;
  // Wrist and fingers; the wrist alone; the wrist with open fingers; as far as the fingers let it, then them.
  if (is_free(X_OW, moved)) {
    X_OH_ = X_OW;
    dofs_ = moved;
    return;
  }
  if (is_free(X_OW, dofs_)) {
    X_OH_ = X_OW;
    return;
  }
  const VecX opened = towards(open_, seconds);
  if (is_free(X_OW, opened)) {
    X_OH_ = X_OW;
    dofs_ = opened;
    return;
  }
  blocked_ = true;
  go_as_far_as_free(X_OW);
  if (is_free(X_OH_, moved)) dofs_ = moved;
  is_free(X_OH_, dofs_);  // the link poses of what is shown
}

void ShownHand::hold(const Grasp& grasp) {
  const HandModel& hand = *model_.scene().hand;
  X_OH_ = grasp.X_OH;
  dofs_ = grasp.grasp_dofs;
  joints_ = joint_values(hand, dofs_);
  for (const auto& [name, value] : grasp.grasp_joints) joints_[hand.find_joint(name)] = value;
  compute_link_poses(hand, joints_, X_OH_, X_OL_);
}

void ShownHand::let_go(const Grasp& grasp) {
  joints_.resize(0);
  X_OH_ = grasp.X_OH_pregrasp;
  dofs_ = grasp.pregrasp_dofs;
  is_free(X_OH_, dofs_);
}

}  // namespace eigengrasp
