// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/graspit_io.hpp"
#include "model_io/graspit_xml.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// Looks for the named file in all folders above the world file.
std::filesystem::path find_model(const XmlElement& filename) {
  namespace fs = std::filesystem;
  const fs::path named = filename.require_text();
  std::error_code ec;
  const fs::path start = fs::absolute(filename.file()).lexically_normal().parent_path();
  for (fs::path folder = start;; folder = folder.parent_path()) {
    if (fs::is_regular_file(folder / named, ec)) return folder / named;
    if (folder == folder.parent_path()) break;
  }
  filename.fail("<filename> is \"{}\", but it exists in none of the folders above {}", shown(filename.text()),
                filename.file().filename().string());
}

Pose read_pose(const XmlElement& element) {
  const XmlElement transform = element.child("transform");
  return transform ? read_graspit_transform(transform) : Pose::Identity();
}

}  // namespace

GraspitWorld load_graspit_world(const std::filesystem::path& file) {
  const XmlFile xml(file);
  const XmlElement root = xml.require_root("world");
  GraspitWorld world;
  for (const XmlElement& element : root.children()) {
    const bool graspable = element.name() == "graspableBody";
    if (graspable || element.name() == "obstacle") {
      auto& bodies = graspable ? world.graspable : world.obstacles;
      bodies.push_back({find_model(element.require_child("filename")), read_pose(element)});
    } else if (element.name() == "robot") {
      const XmlElement values = element.child("dofValues");
      world.robots.push_back({find_model(element.require_child("filename")), read_pose(element),
                              values ? values.numbers(-1) : std::vector<double>()});
    }
  }
  return world;
}

VecX graspit_posture(const HandModel& hand, const std::vector<double>& dof_values) {
  VecX posture(hand.n_dof());
  std::size_t next = 0;
  const auto take = [&](const std::string& what) {
    if (next == dof_values.size()) {
      fail("the {} dof values of {} end before the {}, expected more", dof_values.size(), hand.name, what);
    }
    return dof_values[next++];
  };
  for (int d = 0; d < hand.n_dof(); ++d) {
    const HandDof& dof = hand.dofs[static_cast<std::size_t>(d)];
    posture[d] = take("value of " + dof.name);
    if (dof.type != DofType::breakaway) continue;
    for (const HandJoint& joint : hand.joints) {
      if (joint.dof != d) continue;
      const double flag = take("flag of " + joint.name);
      if (flag != 0.0 && flag != 1.0) {
        fail("the flag of {} is {}, expected 0, or 1 where it broke away", joint.name, flag);
      }
      if (flag == 1.0) take("value of " + joint.name);
    }
  }
  if (next != dof_values.size()) {
    fail("{} dof values, expected {} for {}", dof_values.size(), next, hand.name);
  }
  return posture;
}

}  // namespace eigengrasp
