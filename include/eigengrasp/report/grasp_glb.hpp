// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/grasp/scene.hpp"

namespace eigengrasp {

/// Which posture of a grasp is written.
enum class GraspPhase { pregrasp, grasp };

/// One grasp as binary glTF 2.0 [m]. The root node "object_frame" turns z up to glTF's y up; below it stand,
/// in the object frame, a node "link:NAME" for each link with geometry, "object:NAME", "obstacle:NAME" for
/// each obstacle, and "contact:N" with a small ball for each contact. Each kind has a material of its own.
/// @throws Error where the grasp names a joint that the hand does not have.
std::string grasp_glb(const Scene& scene, const Grasp& grasp, GraspPhase phase = GraspPhase::grasp);

/// @throws Error where the file cannot be written; it is then as it was.
void save_grasp_glb(const Scene& scene, const Grasp& grasp, const std::filesystem::path& path,
                    GraspPhase phase = GraspPhase::grasp);

}  // namespace eigengrasp
