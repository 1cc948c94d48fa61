// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "online/approach_space.hpp"

#include <algorithm>
#include <cmath>

namespace eigengrasp {

namespace {

constexpr double largest_jump = 1.0 / 3.0;  ///< of a variable, share of its range (GraspIt!)

constexpr double before_object = 0.05;  // [m] no grasp is farther from the object's ball

/// Range after a target: as it was without confidence, the value alone with full confidence.
ApproachSpace::Range towards(const ApproachSpace::Range& range, double value, double confidence) {
  const double wide = (1.0 - confidence) * (range.high - range.low);
  const double aim = std::clamp(value, range.low, range.high);
  ApproachSpace::Range narrow{std::max(range.low, aim - wide), std::min(range.high, aim + wide), 0.0};
  narrow.jump = range.jump * (narrow.high - narrow.low) / std::max(range.high - range.low, 1e-12);
  return narrow;
}

Eigen::Vector3d any_across(const Vec3& d) {
  const Vec3 least = std::abs(d.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  return d.cross(least).normalized();
}

}  // namespace

ApproachSpace::ApproachSpace(const Scene& scene, const OnlineOptions& options)
    : scene_(scene),
      postures_(scene.hand->eigengrasps.with_size(options.amplitudes, scene.hand->dof_min(),
                                                  scene.hand->dof_max())),
      n_amplitudes_(options.amplitudes),
      half_angle_(options.cone_half_angle),
      look_ahead_(options.look_ahead),
      step_back_(options.step_back) {
  const Vec3& d = scene.hand->approach_direction_H;
  across_[0] = any_across(d);
  across_[1] = d.cross(across_[0]);
  follow(Pose::Identity());
}

void ApproachSpace::follow(const Pose& X_OW) {
  X_OW_ = X_OW;
  const HandModel& hand = *scene_.hand;
  const ObjectModel& object = *scene_.object;
  const Vec3 apex = X_OW * hand.approach_point_H;
  const double center = (object.center_of_mass - apex).norm();
  const double farthest = std::min(look_ahead_, center + object.max_radius);
  const double nearest =
      std::max(-step_back_, std::min(farthest, center - object.max_radius - before_object));
  const auto range = [](double low, double high) { return Range{low, high, largest_jump * (high - low)}; };
  ranges_.assign(
      {range(nearest, farthest), range(-half_angle_, half_angle_), range(-half_angle_, half_angle_)});
  for (int i = 0; i < n_amplitudes_; ++i) ranges_.push_back(range(postures_[i].min, postures_[i].max));
  narrow_ranges();
}

void ApproachSpace::aim(std::vector<VariableTarget> targets) {
  targets_ = std::move(targets);
  follow(X_OW_);
}

void ApproachSpace::narrow_ranges() {
  double theta = 0.0, phi = 0.0, theta_confidence = 0.0, phi_confidence = 0.0;
  for (const VariableTarget& t : targets_) {
    switch (t.variable) {
      case VariableTarget::Variable::distance:
        ranges_[0] = towards(ranges_[0], t.value, t.confidence);
        break;
      case VariableTarget::Variable::amplitude: {
        Range& r = ranges_[static_cast<std::size_t>(first_amplitude + t.index)];
        r = towards(r, t.value, t.confidence);
        break;
      }
      case VariableTarget::Variable::theta:
        theta = t.value;
        theta_confidence = t.confidence;
        break;
      case VariableTarget::Variable::phi:
        phi = t.value;
        phi_confidence = t.confidence;
        break;
      case VariableTarget::Variable::dof:
        break;
    }
  }
  // The direction of a lean means something only together with how far it leans.
  const double confidence = theta == 0.0 ? theta_confidence : std::min(theta_confidence, phi_confidence);
  ranges_[1] = towards(ranges_[1], theta * std::cos(phi), confidence);
  ranges_[2] = towards(ranges_[2], theta * std::sin(phi), confidence);
}

double ApproachSpace::variable(const ApproachState& state, int i) const {
  if (i == 0) return state.distance;
  return i < first_amplitude ? state.lean[i - 1] : state.amplitudes[i - first_amplitude];
}

void ApproachSpace::set_variable(ApproachState& state, int i, double value) const {
  if (i == 0) {
    state.distance = value;
  } else if (i < first_amplitude) {
    state.lean[i - 1] = value;
  } else {
    state.amplitudes[i - first_amplitude] = value;
  }
}

void ApproachSpace::clamp(ApproachState& state) const {
  for (int i = 0; i < size(); ++i) {
    const Range& r = ranges_[static_cast<std::size_t>(i)];
    set_variable(state, i, std::clamp(variable(state, i), r.low, r.high));
  }
  const double theta = state.lean.norm();
  if (theta > half_angle_) state.lean *= half_angle_ / theta;
}

HandState ApproachSpace::hand_state(const ApproachState& state) const {
  const HandModel& hand = *scene_.hand;
  // Leaning by phi turns the approach direction towards cos(phi) across_0 + sin(phi) across_1.
  const Vec3 towards_H = state.lean[0] * across_[0] + state.lean[1] * across_[1];
  const Vec3 turn_H = hand.approach_direction_H.cross(towards_H);
  const double theta = turn_H.norm();
  const Eigen::Quaterniond lean = theta > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(theta, turn_H / theta))
                                              : Eigen::Quaterniond::Identity();
  HandState hand_state;
  hand_state.q_OA = (orientation(X_OW_) * lean).normalized();
  hand_state.p_OA =
      X_OW_ * hand.approach_point_H + hand_state.q_OA * (state.distance * hand.approach_direction_H);
  hand_state.amplitudes = state.amplitudes;
  return hand_state;
}

void ApproachSpace::move_on(ApproachState& state, const Pose& X_OW_before) const {
  const HandModel& hand = *scene_.hand;
  const Vec3 moved = (X_OW_ * hand.approach_point_H) - (X_OW_before * hand.approach_point_H);
  state.distance -= moved.dot(X_OW_.linear() * hand.approach_direction_H);
  clamp(state);
}

SearchCone ApproachSpace::cone() const {
  const HandModel& hand = *scene_.hand;
  return {X_OW_ * hand.approach_point_H, X_OW_.linear() * hand.approach_direction_H, half_angle_,
          ranges_[0].low, ranges_[0].high};
}

ApproachOffset offset_from(const HandModel& hand, const Pose& X_OW, const Pose& X_OH) {
  const Vec3 axis = X_OW.linear() * hand.approach_direction_H;
  const Vec3 between = X_OH * hand.approach_point_H - X_OW * hand.approach_point_H;
  ApproachOffset offset;
  offset.distance = between.dot(axis);
  offset.offset = (between - offset.distance * axis).norm();
  offset.angle = Eigen::AngleAxisd(X_OW.linear().transpose() * X_OH.linear()).angle();
  return offset;
}

}  // namespace eigengrasp
