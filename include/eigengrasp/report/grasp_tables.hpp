// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// Which parts of a hand a grasp touches with.
struct TouchingParts {
  int fingers = 0;    ///< fingers with at least one contact: branches of the kinematic tree beyond the palm
  bool palm = false;  ///< a contact on the base or on a link between it and the fingers
};
/// Links that the hand does not have are not counted.
TouchingParts touching_parts(const HandModel& hand, const Grasp& grasp);

/// A table for a terminal, a line for each grasp under a line of headings: rank, epsilon, volume, energy,
/// contacts, touching fingers and palm, closed. At most `rows` lines (0: all). Ends with a newline.
std::string grasps_table(const HandModel& hand, std::span<const Grasp> grasps, int rows = 0);

/// Comma-separated values (RFC 4180): a row for each grasp with rank, names, numbers, both hand poses
/// (m, quaternion w x y z), the joint values of pre-grasp and grasp by name [rad or m]. The joints are those
/// of the first grasp.
std::string grasps_csv(std::span<const Grasp> grasps);

/// @throws Error where the file cannot be written; it is then as it was.
void save_grasps_csv(std::span<const Grasp> grasps, const std::filesystem::path& path);

/// NVIDIA's isaac_grasp YAML 1.0: each grasp with its confidence (epsilon), pose of the hand base in the
/// object frame, joint values of grasp and pre-grasp.
std::string isaac_grasp_yaml(const HandModel& hand, std::span<const Grasp> grasps);

}  // namespace eigengrasp
