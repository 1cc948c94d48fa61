// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <optional>

#include "eigengrasp/model_io/hand_io.hpp"
#include "model_io/graspit_xml.hpp"

namespace eigengrasp {

/// A robot of GraspIt! while it is read: the hand, and what maps the file's numbers to it.
struct GraspitRobot {
  HandModel hand;
  /// A link of GraspIt!, [chain][link]: our link, and GraspIt!'s frame G of it in our link's frame.
  struct LinkFrame {
    int link = 0;
    Pose X_LG = Pose::Identity();
  };
  std::vector<std::vector<LinkFrame>> chains;
  std::map<std::string, GraspitBody> bodies;  ///< read already, by file
};

/// Reads <dof> elements: type and closing speed; limits come with the joints.
void read_graspit_dofs(const XmlElement& robot, GraspitRobot& out, const LogSink& log);

/// Reads one <chain> and appends its joints, links and frames.
void read_graspit_chain(const XmlElement& chain, const std::filesystem::path& body_folder, bool with_meshes,
                        GraspitRobot& out);

/// A link of GraspIt!'s body file, with its surface moved by X_LG into the frame of our link.
HandLink read_graspit_link(const XmlElement& element, const std::filesystem::path& body_folder,
                           bool with_meshes, const Pose& X_LG, GraspitRobot& out);

/// Eigengrasps of a GraspIt! file.
EigengraspSpace read_graspit_eigengrasps(const std::filesystem::path& file, const HandModel& hand);

/// Appends the virtual contacts of a GraspIt! file.
void read_graspit_contacts(const std::filesystem::path& file, GraspitRobot& out);

HandModel load_graspit_robot(const std::filesystem::path& file, const HandReadOptions& options);

}  // namespace eigengrasp
