// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/online/online_planner.hpp"
#include "eigengrasp/planning/state_evaluator.hpp"

namespace eigengrasp {

/// The five variables of the online search (section IV-B): where on the cone ahead of the wrist, and posture.
struct ApproachState {
  double distance = 0.0;  ///< along the leaning approach direction [m]
  /// Lean of the approach direction [rad]: theta times cosine and sine of phi.
  Eigen::Vector2d lean = Eigen::Vector2d::Zero();
  VecX amplitudes;
};

/// Where a hand pose lies as seen from the wrist.
struct ApproachOffset {
  double distance = 0.0;  ///< along the wrist's approach direction [m]
  double angle = 0.0;     ///< of the turn from wrist to pose [rad]
  double offset = 0.0;    ///< sideways [m]
};

/// The conical region ahead of the operator's wrist (Fig. 6): its apex is the hand's approach point at the
/// wrist pose, its axis the hand's approach direction. The hand turns about the apex, so that it looks along
/// the leaning direction, and moves on along it; its roll stays the operator's.
class ApproachSpace {
 public:
  ApproachSpace(const Scene& scene, const OnlineOptions& options);

  /// Takes up a wrist pose: the region begins there, or a little before the object where that
  /// is farther on, and ends behind the object or at the look-ahead.
  void follow(const Pose& X_OW);
  /// Ranges towards what the operator asks for; targets of degrees of freedom are not for this space.
  void aim(std::vector<VariableTarget> targets);

  /// A range that a variable is drawn from, and its largest jump.
  struct Range {
    double low = 0.0;
    double high = 0.0;
    double jump = 0.0;
  };
  static constexpr int first_amplitude = 3;
  int size() const { return first_amplitude + n_amplitudes_; }
  /// Of the variables distance, lean (two), amplitudes.
  const std::vector<Range>& ranges() const { return ranges_; }

  double variable(const ApproachState& state, int i) const;
  void set_variable(ApproachState& state, int i, double value) const;
  /// The state with every variable in its range, and the lean inside the cone.
  void clamp(ApproachState& state) const;

  HandState hand_state(const ApproachState& state) const;
  /// The state as seen from a wrist that has moved on: what it gained along the axis is taken off the
  /// distance.
  void move_on(ApproachState& state, const Pose& X_OW_before) const;

  const Pose& wrist() const { return X_OW_; }
  SearchCone cone() const;
  const EigengraspSpace& postures() const { return postures_; }

 private:
  void narrow_ranges();

  const Scene& scene_;
  EigengraspSpace postures_;
  int n_amplitudes_;
  double half_angle_;
  double look_ahead_;
  double step_back_;
  Pose X_OW_ = Pose::Identity();
  Vec3 across_[2];  ///< of the hand frame, at right angles to the approach direction and to each other
  std::vector<VariableTarget> targets_;
  std::vector<Range> ranges_;
};

/// A hand pose as seen from a wrist pose.
ApproachOffset offset_from(const HandModel& hand, const Pose& X_OW, const Pose& X_OH);

}  // namespace eigengrasp
