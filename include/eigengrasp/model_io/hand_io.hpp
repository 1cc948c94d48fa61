// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <vector>

#include "eigengrasp/core/log.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

struct HandReadOptions {
  /// false: kinematics only. Links have no meshes, and no pair of links is tested for collision.
  bool load_meshes = true;
  /// GraspIt! robots: files of virtual contacts that replace those of the robot file; all are used together.
  std::vector<std::filesystem::path> graspit_contact_files = {};
  /// GraspIt! robots: file of eigengrasps that replaces that of the robot file.
  std::filesystem::path graspit_eigengrasp_file = {};
  /// For hands of strangers: a folder in which all files that hand.yaml and URDF name must lie. Empty:
  /// anywhere.
  std::filesystem::path only_within = {};
  /// Hears what was assumed where a file says nothing.
  LogSink log = {};
};

/// Reads a hand:
/// - a folder with hand.yaml, or the file itself (docs/hand-format.md);
/// - a URDF file alone: all movable joints without <mimic> are degrees of freedom in the order of the file
///   that rest at 0 (or the nearest limit), do not close, and have no virtual contacts;
/// - a GraspIt! robot (.xml). Links are named palm and chain0_link0, ..., joints chain0_joint0, ..., degrees
///   of freedom d0, ...; the frame chain0_link0 is GraspIt!'s frame of that link. The rest posture is 0.
///   Compliant degrees of freedom (type c) close like break-away ones.
/// Links without a surface behind fixed joints become frames of the links that carry them.
/// @throws Error, one sentence with file, line, the value found and what was expected.
HandModel load_hand(const std::filesystem::path& path, const HandReadOptions& options = {});

}  // namespace eigengrasp
