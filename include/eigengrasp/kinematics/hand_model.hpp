// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "eigengrasp/contact/material.hpp"
#include "eigengrasp/core/pose.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "eigengrasp/kinematics/eigengrasp_space.hpp"

namespace eigengrasp {

/// Frames: H the hand base (the palm), L a link, P the parent link of a joint, J the joint's frame at rest
/// (value 0). The frame of a link that a joint moves is J after the motion.

enum class JointType { fixed, revolute, prismatic };

struct HandJoint {
  std::string name;
  JointType type = JointType::revolute;
  int parent_link = 0;           ///< index of the parent link, smaller than the child's
  Pose X_PJ = Pose::Identity();  ///< joint frame in the parent link's frame
  Vec3 axis_J = Vec3::UnitZ();   ///< unit axis of rotation or sliding
  int dof = -1;                  ///< driving degree of freedom, -1 for a fixed joint
  double ratio = 1.0;            ///< value = ratio * dof + offset [rad or m]
  double offset = 0.0;
  double min = 0.0;  ///< limits of the value
  double max = 0.0;
};

struct HandLink {
  std::string name;
  TriangleMesh mesh;  ///< in the link frame [m]; may be empty
  Material material;
  double mass = 0.0;  ///< [kg]; 0 where unknown
};

enum class DofType {
  rigid,      ///< all joints of the degree of freedom stop together
  breakaway,  ///< when a contact stops one joint, the joints beyond it go on
};

struct HandDof {
  std::string name;
  DofType type = DofType::rigid;
  double min = 0.0;  ///< intersection of the limits of its joints [rad or m]
  double max = 0.0;
  double rest = 0.0;           ///< open posture
  double closing_speed = 0.0;  ///< [rad/s or m/s]; positive closes towards max; 0 stays
};

/// A point of a link where a contact is wanted (Fig. 1 of the paper).
struct VirtualContact {
  int link = 0;
  Vec3 p_LC = Vec3::Zero();   ///< on the surface [m]
  Vec3 n_LC = Vec3::UnitZ();  ///< unit, outwards (from the hand towards an object)
};

/// A named frame that is fixed to a link, such as a fingertip.
struct HandFrame {
  std::string name;
  int link = 0;
  Pose X_LF = Pose::Identity();
};

/// A hand: kinematic tree, surfaces, and what a planner needs to know. Plain data, immutable once loaded,
/// shared by all threads. Links stand parents first; link 0 is the base; joints[i] moves links[i + 1].
struct HandModel {
  std::string name;
  std::string title;
  std::filesystem::path source;  ///< the file it was read from
  std::vector<HandLink> links;
  std::vector<HandJoint> joints;
  std::vector<HandDof> dofs;
  std::vector<HandFrame> frames;
  std::vector<VirtualContact> virtual_contacts;
  /// Pairs of links, smaller index first, that must not touch each other.
  std::vector<std::array<int, 2>> collision_pairs;
  Vec3 approach_point_H = Vec3::Zero();       ///< in front of the palm [m]
  Vec3 approach_direction_H = Vec3::UnitZ();  ///< unit, from the palm towards the object
  EigengraspSpace eigengrasps;

  int n_links() const { return static_cast<int>(links.size()); }
  int n_joints() const { return static_cast<int>(joints.size()); }
  int n_dof() const { return static_cast<int>(dofs.size()); }
  VecX dof_min() const;
  VecX dof_max() const;
  VecX rest_posture() const;
  std::vector<std::string> dof_names() const;
  /// Index of the named link, joint, frame; -1 where there is none.
  int find_link(const std::string& link_name) const;
  int find_joint(const std::string& joint_name) const;
  int find_frame(const std::string& frame_name) const;
};

/// Sets collision_pairs to all pairs of links with geometry but for neighbours (the next links with geometry
/// up and down the tree, and links fixed to each other) and the given pairs of link indices.
void set_collision_pairs(HandModel& hand, const std::vector<std::array<int, 2>>& ignored);

/// Throws std::logic_error with the first broken invariant: order of the tree, indices in range, unit
/// vectors, finite numbers, min <= max, sizes of the eigengrasp space.
void check_invariants(const HandModel& hand);

}  // namespace eigengrasp
