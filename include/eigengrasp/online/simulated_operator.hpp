// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/online/online_view.hpp"

namespace eigengrasp {

/// How the simulated operator moves, sees and holds still. Defaults: a practised person with a magnetic
/// tracker.
struct OperatorTraits {
  double start_distance = 0.20;   ///< of the approach point from the object's surface ball [m]
  double aim_error = 0.02;        ///< of the point that the palm faces, standard deviation a coordinate [m]
  double speed = 0.25;            ///< of the wrist [m/s]
  double turn_speed = 1.5;        ///< [rad/s]
  double reaction = 0.20;         ///< from what is seen to what is done about it [s]
  double tremor = 0.0005;         ///< amplitude of 8-12 Hz shaking of the hand [m]
  double tremor_turn = 0.005;     ///< [rad]
  double tracker_noise = 0.0003;  ///< standard deviation a coordinate [m]
  double tracker_turn_noise = 0.003;  ///< [rad]
  double lost_samples = 0.02;         ///< share of the tracker's readings that never come
  double late_samples = 0.02;         ///< share that come after the next one
  double repeated_samples = 0.01;     ///< share that come twice
  double change_of_mind = 0.15;  ///< share of approaches that are given up for another direction on the way
  double least_epsilon = 0.01;   ///< of closing now, for a click
  double patience = 1.5;         ///< [s] at the offered pre-grasp, without that, until another direction
  double give_up = 4.0;          ///< [s] without an offer until another direction is tried
  bool from_above = false;       ///< only directions from the upper half space (+z): there is a table
};

/// What the operator does in one step.
struct OperatorAction {
  std::vector<WristSample> samples;  ///< that reach the planner now, in this order
  std::optional<OperatorCommand> command;
};

/// Approaches the object from random directions, follows what the planner offers, and clicks. Drives an
/// online planner without a person. Deterministic: depends on the seed and on the views that it is shown.
class SimulatedOperator {
 public:
  SimulatedOperator(const Scene& scene, const OperatorTraits& traits, std::uint64_t seed);

  /// Begins a new approach from a random direction.
  void begin();
  /// One step. @param view what the planner shows now @param seconds since the last step, > 0
  OperatorAction step(const OnlineView& view, double seconds);

  /// Where the hand truly is; the tracker's readings are noisy.
  const Pose& wrist() const { return X_OW_; }
  double time() const { return time_; }           ///< [s] since it was made
  int directions() const { return directions_; }  ///< tried since begin()

 private:
  /// What the operator saw, to be reacted to later.
  struct Glance {
    double time = 0.0;
    bool offer = false;
    bool ready = false;  ///< closing now would hold well enough
    Pose offer_X_OH = Pose::Identity();
  };

  Pose draw_start();
  void choose_direction();
  void react(const Glance& seen);
  bool satisfied(const Glance& seen) const;
  void move(double seconds);
  void move_around(double seconds);
  Pose shaken();
  void read_tracker(OperatorAction& action);
  Vec3 noise(double deviation);

  const Scene& scene_;
  OperatorTraits traits_;
  RandomStream random_;
  double time_ = 0.0;
  int directions_ = 0;
  bool moving_around_ = false;    ///< the object, to another direction
  double mind_changes_at_ = 0.0;  ///< [s]
  double offer_seen_ = 0.0;       ///< [s] when there last was one, or this direction began
  std::optional<double> at_goal_since_;
  Pose X_OW_ = Pose::Identity();
  Pose start_ = Pose::Identity();  ///< of the present direction
  Pose goal_ = Pose::Identity();
  bool goal_is_offer_ = false;
  std::deque<Glance> glances_;
  std::optional<WristSample> withheld_;
};

}  // namespace eigengrasp
