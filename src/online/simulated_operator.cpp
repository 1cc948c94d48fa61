// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/online/simulated_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace eigengrasp {

namespace {

constexpr double at_goal_distance = 0.004;  // [m]
constexpr double at_goal_angle = 0.05;      // [rad]
constexpr double slows_down = 4.0;          // [1/s] speed a metre of way that is left
constexpr double creep = 0.3;               // share of the speed while nothing is offered
constexpr double standoff = 0.03;           // [m] from the object's ball, without an offer
constexpr double around_speed = 3.0;        // [rad/s] about the object, to another direction
constexpr double shake_hertz[] = {8.3, 9.1, 9.7, 10.3, 11.2, 11.9};

Eigen::Quaterniond turn(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  return angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle))
                     : Eigen::Quaterniond::Identity();
}

/// The share of a turn by `angle` that a step allows.
double share_of(double angle, double most) {
  return angle > most ? most / angle : 1.0;
}

}  // namespace

SimulatedOperator::SimulatedOperator(const Scene& scene, const OperatorTraits& traits, std::uint64_t seed)
    : scene_(scene), traits_(traits), random_({seed, 77}) {
  begin();
}

Vec3 SimulatedOperator::noise(double deviation) {
  return deviation * Vec3(random_.normal(), random_.normal(), random_.normal());
}

/// A wrist pose at some distance from the object, palm towards it, from any side and at any roll.
Pose SimulatedOperator::draw_start() {
  const HandModel& hand = *scene_.hand;
  Vec3 from = noise(1.0).normalized();
  if (traits_.from_above) from.z() = std::abs(from.z());
  const Vec3 target = scene_.object->center_of_mass + noise(traits_.aim_error);
  const Vec3 approach_point =
      scene_.object->center_of_mass + (scene_.object->max_radius + traits_.start_distance) * from;
  const Vec3 axis = (target - approach_point).normalized();
  const Eigen::Quaterniond facing = Eigen::Quaterniond::FromTwoVectors(hand.approach_direction_H, axis);
  const Eigen::Quaterniond roll(
      Eigen::AngleAxisd(random_.uniform(0.0, 2.0 * std::numbers::pi), hand.approach_direction_H));
  const Eigen::Quaterniond q = facing * roll;
  return make_pose(q, approach_point - q * hand.approach_point_H);
}

void SimulatedOperator::choose_direction() {
  start_ = draw_start();
  goal_is_offer_ = false;
  at_goal_since_.reset();
  offer_seen_ = time_;
  ++directions_;
  const bool changes = random_.uniform() < traits_.change_of_mind;
  mind_changes_at_ = changes ? time_ + random_.uniform(0.2, 1.5) : std::numeric_limits<double>::infinity();
}

void SimulatedOperator::begin() {
  directions_ = 0;
  choose_direction();
  X_OW_ = goal_ = start_;
  moving_around_ = false;
  glances_.clear();
  withheld_.reset();
}

OperatorAction SimulatedOperator::step(const OnlineView& view, double seconds) {
  time_ += seconds;
  glances_.push_back({time_, view.offer.has_value(), view.epsilon_now.value_or(-1.0) >= traits_.least_epsilon,
                      view.offer_X_OH});
  std::optional<Glance> seen;
  while (!glances_.empty() && glances_.front().time <= time_ - traits_.reaction) {
    seen = glances_.front();
    glances_.pop_front();
  }
  OperatorAction action;
  if (seen) react(*seen);
  if (moving_around_) {
    move_around(seconds);
  } else {
    move(seconds);
    if (seen && satisfied(*seen)) action.command = OperatorCommand::close;
  }
  read_tracker(action);
  return action;
}

void SimulatedOperator::react(const Glance& seen) {
  if (seen.offer) offer_seen_ = time_;
  if (moving_around_) return;
  const bool impatient = at_goal_since_ && !seen.ready && time_ - *at_goal_since_ > traits_.patience;
  if (impatient || time_ >= mind_changes_at_ || time_ - offer_seen_ > traits_.give_up) {
    choose_direction();
    moving_around_ = true;
    return;
  }
  const HandModel& hand = *scene_.hand;
  goal_is_offer_ = seen.offer;
  if (seen.offer) {
    goal_ = seen.offer_X_OH;
    return;
  }
  const double way = traits_.start_distance - standoff;
  goal_ = start_ * Eigen::Translation3d(way * hand.approach_direction_H);
}

bool SimulatedOperator::satisfied(const Glance& seen) const {
  return goal_is_offer_ && at_goal_since_ && seen.ready;
}

void SimulatedOperator::move(double seconds) {
  const HandModel& hand = *scene_.hand;
  const Vec3 way = goal_ * hand.approach_point_H - X_OW_ * hand.approach_point_H;
  const double left = way.norm();
  const double angle = angle_between(X_OW_.linear(), goal_.linear());
  const double speed = std::min(traits_.speed * (goal_is_offer_ ? 1.0 : creep), slows_down * left + 0.01);
  const double turn_speed = std::min(traits_.turn_speed, slows_down * angle + 0.05);
  const Eigen::Quaterniond q =
      orientation(X_OW_).slerp(share_of(angle, turn_speed * seconds), orientation(goal_));
  const Vec3 p = X_OW_ * hand.approach_point_H + share_of(left, speed * seconds) * way;
  X_OW_ = make_pose(q, p - q * hand.approach_point_H);
  const bool there = left < at_goal_distance && angle < at_goal_angle;
  if (!there) at_goal_since_.reset();
  if (there && !at_goal_since_) at_goal_since_ = time_;
}

/// Back from the object and around it, to where the new direction starts.
void SimulatedOperator::move_around(double seconds) {
  const HandModel& hand = *scene_.hand;
  const Vec3& center = scene_.object->center_of_mass;
  const Vec3 here = X_OW_ * hand.approach_point_H - center;
  const Vec3 there = start_ * hand.approach_point_H - center;
  const double most = traits_.speed * 2.0 * seconds;
  const double radius = here.norm() + std::clamp(there.norm() - here.norm(), -most, most);
  const Eigen::Quaterniond whole = Eigen::Quaterniond::FromTwoVectors(here, there);
  const double angle = Eigen::AngleAxisd(whole).angle();
  const bool far_enough = here.norm() > 0.9 * there.norm();
  const double share = far_enough ? share_of(angle, around_speed * seconds) : 0.0;
  const Vec3 direction = Eigen::Quaterniond::Identity().slerp(share, whole) * here.normalized();
  const double turn_angle = angle_between(X_OW_.linear(), start_.linear());
  const Eigen::Quaterniond q =
      orientation(X_OW_).slerp(share_of(turn_angle, around_speed * seconds), orientation(start_));
  X_OW_ = make_pose(q, center + radius * direction - q * hand.approach_point_H);
  if ((X_OW_.translation() - start_.translation()).norm() > at_goal_distance ||
      angle_between(X_OW_.linear(), start_.linear()) > at_goal_angle)
    return;
  moving_around_ = false;
  goal_ = start_;
  offer_seen_ = time_;
}

/// What the tracker would read of the hand that trembles.
Pose SimulatedOperator::shaken() {
  double wave[6];
  for (int i = 0; i < 6; ++i)
    wave[i] = std::sin(2.0 * std::numbers::pi * (shake_hertz[i] * time_ + 0.17 * i));
  const Vec3 shift = traits_.tremor * Vec3(wave[0], wave[1], wave[2]) + noise(traits_.tracker_noise);
  const Vec3 turned =
      traits_.tremor_turn * Vec3(wave[3], wave[4], wave[5]) + noise(traits_.tracker_turn_noise);
  return make_pose(orientation(X_OW_) * turn(turned), X_OW_.translation() + shift);
}

void SimulatedOperator::read_tracker(OperatorAction& action) {
  const WristSample sample{time_, shaken()};
  const double fate = random_.uniform();
  const double lost = traits_.lost_samples;
  const double late = lost + traits_.late_samples;
  const double twice = late + traits_.repeated_samples;
  if (fate >= lost && fate < late && !withheld_) {
    withheld_ = sample;
    return;
  }
  if (fate >= lost) action.samples.push_back(sample);
  if (fate >= late && fate < twice) action.samples.push_back(sample);
  if (withheld_ && !action.samples.empty()) {
    action.samples.push_back(*withheld_);
    withheld_.reset();
  }
}

}  // namespace eigengrasp
