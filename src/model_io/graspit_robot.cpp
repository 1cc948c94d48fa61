// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/graspit_robot.hpp"

#include <algorithm>
#include <set>

#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "model_io/hand_assembly.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// Links this close in the pose in which a robot is loaded may touch ever after.
constexpr double touching_distance = 0.2e-3;

void say(const LogSink& log, const std::string& sentence) {
  if (log) log(sentence);
}

void set_limits(const XmlElement& robot, HandModel& hand) {
  const int bad = set_dof_limits(hand);
  if (bad < 0) return;
  const XmlElement element = robot.children("dof")[static_cast<std::size_t>(bad)];
  const bool drives = std::any_of(hand.joints.begin(), hand.joints.end(),
                                  [bad](const HandJoint& joint) { return joint.dof == bad; });
  if (!drives) element.fail("d{} drives no joint, expected one that names it", bad);
  element.fail("the limits of the joints of d{} have no value in common, expected a range", bad);
}

/// A degree of freedom in millimetres cannot turn a joint.
void check_joint_types(const XmlElement& robot, const HandModel& hand) {
  for (int d = 0; d < hand.n_dof(); ++d) {
    std::set<JointType> types;
    for (const HandJoint& joint : hand.joints)
      if (joint.dof == d) types.insert(joint.type);
    if (types.size() > 1) {
      robot.children("dof")[static_cast<std::size_t>(d)].fail(
          "d{} drives joints that turn and joints that slide, expected one kind", d);
    }
  }
}

void read_approach(const XmlElement& robot, HandModel& hand, const LogSink& log) {
  const XmlElement approach = robot.child("approachDirection");
  if (!approach) {
    say(log, fmt::format("{}: has no <approachDirection>; the hand comes along the palm's z axis",
                         robot.file().string()));
    return;
  }
  hand.approach_point_H = metres_of_mm * approach.require_child("referenceLocation").vector();
  const XmlElement direction = approach.require_child("direction");
  if (direction.vector().norm() < 1e-6) {
    direction.fail("<direction> is \"{}\", expected a direction that is not zero", shown(direction.text()));
  }
  hand.approach_direction_H = direction.vector().normalized();
}

/// The file that an element names, relative to the robot's folder.
std::filesystem::path named_file(const XmlElement& element) {
  const auto file = element.file().parent_path() / element.require_text();
  std::error_code ec;
  if (!std::filesystem::is_regular_file(file, ec)) {
    element.fail("<{}> is \"{}\", but {} does not exist", element.name(), shown(element.text()),
                 file.string());
  }
  return file;
}

void read_extras(const XmlElement& robot, const HandReadOptions& options, GraspitRobot& out) {
  read_approach(robot, out.hand, options.log);
  const XmlElement eigengrasps = robot.child("eigenGrasps");
  if (!options.graspit_eigengrasp_file.empty()) {
    out.hand.eigengrasps = read_graspit_eigengrasps(options.graspit_eigengrasp_file, out.hand);
  } else if (eigengrasps) {
    out.hand.eigengrasps = read_graspit_eigengrasps(named_file(eigengrasps), out.hand);
  } else {
    say(options.log, fmt::format("{}: names no eigengrasps; every degree of freedom is a direction",
                                 robot.file().string()));
    out.hand.eigengrasps = all_postures(out.hand);
  }
  const XmlElement contacts = robot.child("virtualContacts");
  if (!options.graspit_contact_files.empty()) {
    for (const auto& file : options.graspit_contact_files) read_graspit_contacts(file, out);
  } else if (contacts) {
    read_graspit_contacts(named_file(contacts), out);
  } else {
    say(options.log, fmt::format("{}: names no virtual contacts; the hand has none", robot.file().string()));
  }
}

/// GraspIt!'s rules: no links of one chain, no first link of a chain with the palm, no pair that touches in
/// the rest posture.
void set_graspit_collision_pairs(GraspitRobot& robot) {
  HandModel& hand = robot.hand;
  std::vector<int> chain_of(hand.links.size(), -1);
  std::set<int> beside_palm;
  for (std::size_t c = 0; c < robot.chains.size(); ++c) {
    for (const auto& frame : robot.chains[c])
      chain_of[static_cast<std::size_t>(frame.link)] = static_cast<int>(c);
    beside_palm.insert(robot.chains[c].front().link);
  }
  std::vector<MeshBvh> surfaces;
  for (const HandLink& link : hand.links) surfaces.emplace_back(link.mesh);
  std::vector<Pose> X_HL;
  compute_link_poses(hand, joint_values(hand, hand.rest_posture()), Pose::Identity(), X_HL);
  for (int a = 0; a < hand.n_links(); ++a) {
    for (int b = a + 1; b < hand.n_links(); ++b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      if (hand.links[i].mesh.empty() || hand.links[j].mesh.empty()) continue;
      if (chain_of[i] == chain_of[j] || (a == 0 && beside_palm.contains(b))) continue;
      const Pose X_AB = X_HL[i].inverse() * X_HL[j];
      const bool touch = intersects(surfaces[i], surfaces[j], X_AB) ||
                         closest_pair(surfaces[i], surfaces[j], X_AB, touching_distance).triangle_a >= 0;
      if (!touch) hand.collision_pairs.push_back({a, b});
    }
  }
}

}  // namespace

void read_graspit_dofs(const XmlElement& robot, GraspitRobot& out, const LogSink& log) {
  for (const XmlElement& element : robot.children("dof")) {
    HandDof dof;
    dof.name = fmt::format("d{}", out.hand.n_dof());
    const std::string type = element.require_attribute("type");
    if (type == "b") {
      dof.type = DofType::breakaway;
    } else if (type == "c") {
      dof.type = DofType::breakaway;
      say(log, fmt::format("{}:{}: {} is compliant; it closes like a break-away one", element.file().string(),
                           element.line(), dof.name));
    } else if (type != "r") {
      element.fail("<dof>: type is \"{}\", expected r (rigid), b (break-away) or c (compliant)", shown(type));
    }
    if (const XmlElement velocity = element.child("defaultVelocity")) dof.closing_speed = velocity.number();
    out.hand.dofs.push_back(dof);
  }
  if (out.hand.dofs.empty()) robot.fail("<robot> has no <dof>, expected at least one");
}

HandModel load_graspit_robot(const std::filesystem::path& file, const HandReadOptions& options) {
  const XmlFile xml(file);
  const XmlElement robot = xml.require_root("robot");
  GraspitRobot out;
  out.hand.name = file.stem().string();
  out.hand.title = fmt::format("GraspIt! robot {}", out.hand.name);
  out.hand.source = file;
  read_graspit_dofs(robot, out, options.log);
  const auto body_folder = file.parent_path() / "iv";
  HandLink palm =
      read_graspit_link(robot.require_child("palm"), body_folder, options.load_meshes, Pose::Identity(), out);
  palm.name = "palm";
  out.hand.links.push_back(std::move(palm));
  for (const XmlElement& chain : robot.children("chain")) {
    read_graspit_chain(chain, body_folder, options.load_meshes, out);
  }
  check_joint_types(robot, out.hand);
  set_limits(robot, out.hand);
  clamp_rest(out.hand);
  read_extras(robot, options, out);
  set_graspit_collision_pairs(out);
  return std::move(out.hand);
}

}  // namespace eigengrasp
