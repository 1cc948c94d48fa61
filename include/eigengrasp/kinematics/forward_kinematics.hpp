// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// Posture p (n_dof) with every degree of freedom inside its limits.
VecX clamp_posture(const HandModel& hand, const VecX& posture);

/// Joint values (n_joints) [rad or m] of a posture (n_dof), by the couplings; fixed joints have 0.
VecX joint_values(const HandModel& hand, const VecX& posture);

/// Degrees of freedom that best explain joint values which break-away may have separated: of each, the value
/// of its joint that went furthest in closing direction.
VecX posture_of_joints(const HandModel& hand, const VecX& joints);

/// Poses X_OL (n_links) of all links for joint values (n_joints) and base pose X_OH. Resizes X_OL only when
/// needed. Cost: 1 us.
void compute_link_poses(const HandModel& hand, const VecX& joints, const Pose& X_OH, std::vector<Pose>& X_OL);

/// Pose X_OL of the link that a joint moves, at a value of the joint [rad or m] and the pose of its parent.
Pose link_pose(const HandJoint& joint, double value, const Pose& X_OP);

/// Velocity of a point p_O fixed to link `link` per unit velocity of joint j [m/rad or m/m]; zero where j
/// does not move the link.
Vec3 point_velocity(const HandModel& hand, const std::vector<Pose>& X_OL, int link, int j, const Vec3& p_O);

/// Whether joint j moves the link, i.e. lies between it and the base.
bool moves_link(const HandModel& hand, int j, int link);

}  // namespace eigengrasp
