// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <string>

#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"
#include "eigengrasp/online/online_planner.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"
#include "eigengrasp/wire/messages.hpp"
#include "eigengrasp/wire/replies.hpp"

/// Messages of what planners find, and what planners take of messages.
namespace eigengrasp::wire {

/// To the last digit.
PoseNumbers pose_numbers(const Pose& X);
Pose to_pose(const PoseNumbers& numbers);

/// For drawing: to 1e-6, within the bounds of the schema (1000 m).
PoseNumbers drawn_pose(const Pose& X);
/// Drawn poses of all links at joint values (n_joints).
LinkPoses link_poses(const HandModel& hand, const VecX& joints, const Pose& X_OH);
/// The same for degrees of freedom (n_dof).
LinkPoses posture_poses(const HandModel& hand, const VecX& dofs, const Pose& X_OH);

/// @param frames of the closing, from pre-grasp to grasp; at least 2
/// @throws Error where the grasp names a joint that the hand does not have.
GraspShape grasp_shape(const HandModel& hand, const Grasp& grasp, int frames = 9);
View::Offer offer_shape(const HandModel& hand, std::uint64_t id, const Grasp& grasp);

/// Without offer and server_ms, which the view itself does not hold.
View view_message(const HandModel& hand, const OnlineView& view);
PlanResultMessage plan_result_message(const std::string& id, const HandModel& hand, const PlanResult& result);

HandEntry hand_entry(const HandModel& hand, bool uploaded);
ObjectEntry object_entry(const std::string& name, const ObjectModel& object, bool uploaded);

WristSample wrist_sample(const Wrist& message);
std::vector<VariableTarget> variable_targets(const Targets& message);
/// All but cache, stop and callbacks.
PlanOptions plan_options(const PlanStart& message);
OnlineOptions online_options(const OnlineStart& message);

}  // namespace eigengrasp::wire
