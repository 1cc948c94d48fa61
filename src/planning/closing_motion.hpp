// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// A closing hand as a function of time [s]: every joint moves from its start at its own constant rate until
/// it is stopped or reaches its end. Poses are worked out link by link, where and when they are asked for.
class ClosingMotion {
 public:
  /// @param posture (n_dof)
  ClosingMotion(const HandModel& hand, const Pose& X_OH, const VecX& posture);

  /// Velocity of joint j [rad/s or m/s]; 0 where it has stopped.
  double rate(int j, double t) const {
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    return t < joint.stop ? joint.rate : 0.0;
  }
  /// Stops joint j at time t, and with it all joints of the same rigid degree of freedom.
  void stop(int j, double t);
  /// When the last joint stops [s].
  double end() const;
  /// Largest velocity of any joint [rad/s or m/s].
  double fastest() const;

  /// Pose X_OL of a link. The reference holds until the next call with another time.
  const Pose& pose(int link, double t);
  /// Values (n_joints) at time t.
  VecX joint_values(double t) const;

 private:
  struct Joint {
    double start = 0.0;
    double rate = 0.0;
    double end = 0.0;    ///< value at the end of its travel
    double limit = 0.0;  ///< time at which it is there
    double stop = 0.0;   ///< time from which on it stands
  };
  struct TimedPose {
    Pose X_OL = Pose::Identity();
    double time = -1.0;
  };
  double value(const Joint& joint, double t) const;

  const HandModel& hand_;
  std::vector<Joint> joints_;
  std::vector<TimedPose> poses_;
};

}  // namespace eigengrasp
