// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// Sets the limits of every degree of freedom to the values that keep all its joints inside theirs.
/// @return index of the first one that has no value left (or no joint), -1 where there is none
int set_dof_limits(HandModel& hand);

/// Moves the rest posture inside the limits.
void clamp_rest(HandModel& hand);

/// The space that spans all postures about the rest posture: what a hand without eigengrasps gets.
EigengraspSpace all_postures(const HandModel& hand);

}  // namespace eigengrasp
