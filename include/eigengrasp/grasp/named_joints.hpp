// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// Joint values (n_joints) by name; joints without a value rest. @throws Error for a name that the hand lacks
VecX joints_by_name(const HandModel& hand, const NamedValues& values);

/// Values of all movable joints with their names. @param joints (n_joints)
NamedValues named_joints(const HandModel& hand, const VecX& joints);

}  // namespace eigengrasp
