// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// For each link the link at the root of its finger: a child of the first link with several children, counted
/// from the base. -1 for the palm: links between the base and there; all links where nothing branches.
std::vector<int> finger_roots(const HandModel& hand);

/// X_HA, the pose of the hand's approach frame A: its origin is the approach point, z the approach direction,
/// x the direction across z in which the hand reaches in its rest posture: to the mean of the virtual
/// contacts or, where that is less than 10 mm off the z axis, to the virtual contact that is farthest from
/// the axis.
Pose approach_frame(const HandModel& hand);

}  // namespace eigengrasp
