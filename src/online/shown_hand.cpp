// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "online/shown_hand.hpp"

#include <algorithm>

#include "eigengrasp/grasp/named_joints.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

constexpr double finger_speed = 4.0;       // [rad/s or m/s], of a degree of freedom
constexpr double still = 0.0025;           // [m] less than that from where the hand is shown is tremor
constexpr double settling = 0.15;          // [s] in which tremor is averaged
constexpr double turn_as_distance = 0.10;  // [m/rad] a turn that is to come counts as that much way
constexpr double full_preshape = 0.02;     // [m] the posture is reached that much before the pre-grasp
constexpr double turned_enough = 0.5;  // [rad] before their place at which fingers that spread begin to close
constexpr int halvings = 3;            // of a way that is not free as a whole
constexpr double start_step = 0.01;    // [m] by which a hand that starts in collision is drawn back
constexpr int most_start_steps = 40;
constexpr double draw_back_step = 0.01;  // [m] by which fingers that do not pass beside the object are drawn
constexpr int most_draw_back_steps = 30;

/// How far a wrist has to go to another [m], turns counted as way.
double way_between(const Pose& X_OA, const Pose& X_OB) {
  return (X_OA.translation() - X_OB.translation()).norm() +
         turn_as_distance * angle_between(X_OA.linear(), X_OB.linear());
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
  const double way = way_between(X_OW, steady_);
  if (way >= still) return X_OW;
  const double lag = settling * (1.0 - way / still);
  return interpolate(steady_, X_OW, seconds / (seconds + lag));
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
    const Pose X_OH = interpolate(from, X_OW, share);
    const bool free = is_free(X_OH, dofs_);
    if (free) X_OH_ = X_OH;
    share += free ? half : -half;
  }
}

/// Between open and the pre-grasp: fingers close as the hand comes near. What does not close, such as the
/// spread of fingers, turns to its place before that, while they are far from the object and from each other.
VecX ShownHand::preshaped(const VecX& pregrasp) const {
  if (preshape_ == 0.0) return open_;
  const auto turns = [&](Eigen::Index i) {
    return model_.scene().hand->dofs[static_cast<std::size_t>(i)].closing_speed == 0.0;
  };
  double to_turn = 0.0;
  for (Eigen::Index i = 0; i < dofs_.size(); ++i)
    if (turns(i)) to_turn = std::max(to_turn, std::abs(pregrasp[i] - dofs_[i]));
  const double closed = preshape_ * std::max(0.0, 1.0 - to_turn / turned_enough);
  VecX dofs = open_ + closed * (pregrasp - open_);
  for (Eigen::Index i = 0; i < dofs.size(); ++i)
    if (turns(i)) dofs[i] = pregrasp[i];
  return dofs;
}

/// Draws the hand back from the wrist until the fingers are free on their way into the pre-grasp posture.
bool ShownHand::draw_back(const Pose& X_OW, const VecX& moved) {
  for (int i = 1; i <= most_draw_back_steps; ++i) {
    const Vec3 back = -i * draw_back_step * model_.scene().hand->approach_direction_H;
    const Pose X_OH = X_OW * Eigen::Translation3d(back);
    if (!is_free(X_OH, moved)) continue;
    X_OH_ = X_OH;
    dofs_ = moved;
    return true;
  }
  return false;
}

void ShownHand::follow(const Pose& X_OW_held, const Grasp* offered, double seconds) {
  Pose X_OW = steady_ = placed_ ? steady(X_OW_held, seconds) : X_OW_held;
  joints_.resize(0);
  preshape_ = 0.0;
  if (offered) {
    const double way = way_between(X_OW, offered->X_OH_pregrasp);
    const double span = std::max(options_.preshape_begins - full_preshape, 1e-6);
    preshape_ = std::clamp((options_.preshape_begins - way) / span, 0.0, 1.0);
    if (way < still) X_OW = offered->X_OH_pregrasp;
  }
  if (!placed_) {
    placed_ = find_free_start(X_OW);
    if (!placed_) {
      blocked_ = true;
      return;
    }
  }
  move(X_OW, towards(offered ? preshaped(offered->pregrasp_dofs) : open_, seconds), towards(open_, seconds));
}

void ShownHand::move(const Pose& X_OW, const VecX& moved, const VecX& opened) {
  blocked_ = false;
  // Wrist and fingers; the wrist alone; the wrist with open fingers; as far as the fingers let it, then them.
  // At the pre-grasp its posture comes first: the fingers pass beside what is in their way with the hand
  // drawn back.
  if (is_free(X_OW, moved)) {
    X_OH_ = X_OW;
    dofs_ = moved;
    return;
  }
  if (preshape_ == 1.0 && draw_back(X_OW, moved)) {
    blocked_ = true;
    return;
  }
  if (is_free(X_OW, dofs_)) {
    X_OH_ = X_OW;
    return;
  }
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
  joints_ = joints_by_name(hand, grasp.grasp_joints);
  compute_link_poses(hand, joints_, X_OH_, X_OL_);
}

void ShownHand::let_go(const Grasp& grasp) {
  joints_.resize(0);
  X_OH_ = grasp.X_OH_pregrasp;
  dofs_ = grasp.pregrasp_dofs;
  is_free(X_OH_, dofs_);
}

}  // namespace eigengrasp
