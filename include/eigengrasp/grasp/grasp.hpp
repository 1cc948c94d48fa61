// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "eigengrasp/contact/contact_point.hpp"
#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// Joint values by name [rad or m].
using NamedValues = std::vector<std::pair<std::string, double>>;

/// A contact point of a grasp and the link that makes it. Points of one touching region share the patch
/// number.
struct GraspContact {
  std::string link;
  int patch = 0;
  ContactPoint point;
};

/// The points alone, as wrench spaces take them.
std::vector<ContactPoint> contact_points(const std::vector<GraspContact>& contacts);

/// Where a grasp came from, so that it can be made again.
struct GraspProvenance {
  std::string planner;  ///< such as "annealing/contact"
  std::uint64_t seed = 0;
  std::string options_digest;  ///< of all options that change the result
  std::string version;         ///< of the program
};

/// The single currency between planner, files, store, wire and viewer. Plain data, SI, object frame O.
struct Grasp {
  std::string hand;
  std::string object;
  double object_scale = 1.0;
  Pose X_OH_pregrasp = Pose::Identity();  ///< hand base at the pre-grasp
  Pose X_OH = Pose::Identity();           ///< hand base at the grasp
  NamedValues pregrasp_joints;            ///< every movable joint of the hand
  NamedValues grasp_joints;
  VecX pregrasp_dofs;  ///< (n_dof)
  VecX grasp_dofs;     ///< (n_dof)
  VecX amplitudes;     ///< of the pre-grasp (size of the eigengrasp space)
  std::vector<GraspContact> contacts;
  double energy = 0.0;   ///< of the pre-grasp, lower is better; unit as the planner's energy says
  double epsilon = 0.0;  ///< [-]
  double volume = 0.0;   ///< [-]
  bool form_closure = false;
  double max_penetration = 0.0;  ///< deepest, checked with exact meshes [m]
  GraspProvenance provenance;
};

}  // namespace eigengrasp
