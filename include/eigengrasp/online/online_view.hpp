// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/online/operator_input.hpp"

namespace eigengrasp {

/// Where a task of grasping stands (section IV-D).
enum class OnlinePhase {
  waiting,   ///< no wrist pose yet
  approach,  ///< the operator moves the wrist, the planner searches ahead of it
  holding,   ///< after "close": the fingers stand closed, the wrist is the grasp's
};

/// A form-closure grasp that was found, as seen from where the wrist is now.
struct OnlineSolution {
  std::uint64_t id = 0;   ///< counts up in the order in which they were found
  double epsilon = 0.0;   ///< [-]
  double distance = 0.0;  ///< from the wrist to its pre-grasp along the approach direction [m]
  double angle = 0.0;     ///< off the present approach: the wrist's turn to it, or the lean of the line to it
                          ///< where that is larger [rad]
  double offset = 0.0;    ///< sideways, off the approach line [m]
  double age = 0.0;       ///< since it was found [s]
};

/// The region that the first stage searches (Fig. 6), in the object frame.
struct SearchCone {
  Vec3 apex = Vec3::Zero();   ///< approach point of the hand at the wrist pose [m]
  Vec3 axis = Vec3::UnitZ();  ///< approach direction
  double half_angle = 0.0;    ///< [rad]
  double nearest = 0.0;       ///< least distance along the axis [m], may be negative
  double farthest = 0.0;      ///< [m]
};

struct OnlineRates {
  double postures_per_second = 0.0;    ///< first stage, over the last second
  double candidates_per_second = 0.0;  ///< second stage, over the last second of work
  std::int64_t postures = 0;
  std::int64_t candidates = 0;
  std::int64_t form_closed = 0;
  double time_to_first_grasp = 0.0;  ///< from the last new approach to its first solution [s]; 0: none yet
};

/// All that is to be shown at one moment: plain data.
struct OnlineView {
  std::uint64_t frame = 0;
  double time = 0.0;  ///< since the planner began [s]
  OnlinePhase phase = OnlinePhase::waiting;
  WristSample wrist;             ///< the newest that was taken in
  Pose X_OH = Pose::Identity();  ///< of the hand that is shown: the wrist, or where that is blocked the
                                 ///< last pose that is free
  bool blocked = false;          ///< the wrist as given would be inside something
  VecX dofs;                     ///< (n_dof) of the hand that is shown; free of collision
  VecX joints;                   ///< (n_joints)
  double preshape = 0.0;         ///< 0: open, 1: the offered pre-grasp's posture
  std::optional<OnlineSolution> offer;
  Pose offer_X_OH = Pose::Identity();     ///< hand base at the offered pre-grasp
  VecX offer_dofs;                        ///< (n_dof) of the offered pre-grasp; empty without offer
  std::vector<OnlineSolution> solutions;  ///< the offered one first
  SearchCone cone;
  OnlineRates rates;
  /// Epsilon of the grasp that "close" would make now: the lowest of the last four tests of the hand as it is
  /// shown, over about 0.2 s, so that it counts under tremor; negative: one of them did not come to form
  /// closure; none: not known yet.
  std::optional<double> epsilon_now;
  std::string message;  ///< one sentence for the operator
};

}  // namespace eigengrasp
