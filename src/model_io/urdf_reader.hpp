// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// A shape of a link, in the link's frame.
struct UrdfShape {
  enum class Kind { mesh, box, cylinder, sphere };
  Kind kind = Kind::box;
  Pose X_LS = Pose::Identity();
  Vec3 size = Vec3::Ones();    ///< mesh: scale; box: sides; cylinder: radius, length, 0; sphere: radius, 0, 0
  std::filesystem::path file;  ///< of a mesh
  int line = 0;
};

struct UrdfLink {
  std::string name;
  int line = 0;
  double mass = 0.0;
  std::vector<UrdfShape> shapes;  ///< <collision>, or <visual> where there is none
};

struct UrdfMimic {
  std::string joint;
  double multiplier = 1.0;
  double offset = 0.0;
};

struct UrdfJoint {
  std::string name;
  int line = 0;
  JointType type = JointType::fixed;
  std::string parent, child;
  Pose X_PJ = Pose::Identity();
  Vec3 axis_J = Vec3::UnitX();
  double lower = 0.0, upper = 0.0;
  std::optional<UrdfMimic> mimic;
};

/// What a URDF file says; joints and links in the order of the file.
struct Urdf {
  std::filesystem::path file;
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
};

/// Reads a URDF file. Its meshes lie in the folder `only_within` where that is not empty.
/// @throws Error with file, line, value and expectation.
Urdf read_urdf(const std::filesystem::path& file, const std::filesystem::path& only_within = {});

/// The joint that each joint moves with, chains of <mimic> resolved: value = multiplier * it + offset.
/// Indexed like Urdf::joints; nothing for joints that are fixed or degrees of freedom themselves.
std::vector<std::optional<UrdfMimic>> resolve_mimics(const Urdf& urdf);

/// Indices of the joints of the tree, parents first, chain after chain in the order of the file; the root
/// link goes to `root`. @throws Error for several roots, cycles, links with two parents.
std::vector<int> order_joints(const Urdf& urdf, int& root);

/// Builds links, joints, frames and degrees of freedom (in the order of the file) of a hand. Leaves what a
/// URDF does not say.
HandModel build_urdf_hand(const Urdf& urdf, bool load_meshes);

/// Surface of a link's shapes; `cache` holds meshes by file.
TriangleMesh load_urdf_shapes(const UrdfLink& link, std::map<std::string, TriangleMesh>& cache);

}  // namespace eigengrasp
