// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <vector>

#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

// Files of GraspIt! (millimetres, degrees, grams); see also load_hand for its robots.

namespace eigengrasp {

/// Triangles of an Open Inventor or VRML file (.iv, .wrl) in the file's outermost frame, vertices multiplied
/// by `scale` (1e-3 for a file in millimetres), welded exactly. Spheres, cylinders and cones come
/// tessellated. Any number of threads may call it; they take turns.
/// @throws Error with the file's name where it is missing, cannot be parsed or holds no triangle.
TriangleMesh load_inventor(const std::filesystem::path& file, double scale);

/// Reads a body XML file: `geometryFile` (.iv, .wrl or what load_mesh reads, relative to the file) with
/// `geometryScaling` and `geometryOffset`, `cog` (absent: the area-weighted mean of the surface), `material`
/// (absent: wood). `unit` is the length of the file's unit in metres; geometry and centre both have it.
/// @throws Error with file, line, value and expectation.
ObjectModel load_graspit_body(const std::filesystem::path& file, double unit = 1e-3);

/// A world: which bodies and robots stand where. Poses in the world frame W [m].
struct GraspitWorld {
  struct Body {
    std::filesystem::path file;  ///< for load_graspit_body
    Pose X_WO = Pose::Identity();
  };
  struct Robot {
    std::filesystem::path file;  ///< for load_hand
    Pose X_WH = Pose::Identity();
    std::vector<double> dof_values;  ///< as written; see graspit_posture
  };
  std::vector<Body> graspable;
  std::vector<Body> obstacles;
  std::vector<Robot> robots;
};

/// Reads a world XML file. File names in it are relative to GraspIt!'s root folder, which is the nearest
/// parent folder of the world file in which they exist. @throws Error with file, line, value and expectation.
GraspitWorld load_graspit_world(const std::filesystem::path& file);

/// Posture (n_dof) of a world file's values: one for a rigid degree of freedom; for a break-away one its
/// value, and of each of its joints 0, or 1 and the value at which it broke away.
/// @throws Error where their number does not fit the hand.
VecX graspit_posture(const HandModel& hand, const std::vector<double>& dof_values);

}  // namespace eigengrasp
