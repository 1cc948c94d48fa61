// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/report/grasp_tables.hpp"

namespace eigengrasp {

namespace {

/// A text between double quotes, as YAML reads it.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

std::string joints_yaml(const NamedValues& joints) {
  std::string out;
  for (const auto& [name, value] : joints)
    out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", quoted(name), value);
  return "{" + out + "}";
}

}  // namespace

std::string isaac_grasp_yaml(const HandModel& hand, std::span<const Grasp> grasps) {
  const std::string base = hand.links.empty() ? "base" : hand.links.front().name;
  std::string out = fmt::format(
      "format: isaac_grasp\nformat_version: 1.0\n\nobject_frame_link: \"object\"\ngripper_frame_link: "
      "{}\n\ngrasps:{}\n",
      quoted(base), grasps.empty() ? " {}" : "");
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const Grasp& grasp = grasps[i];
    const Vec3 p = grasp.X_OH.translation();
    const Eigen::Quaterniond q = orientation(grasp.X_OH);
    out += fmt::format("  \"grasp_{}\":\n    confidence: {}\n", i, grasp.epsilon);
    out += fmt::format("    position: [{}, {}, {}]\n", p.x(), p.y(), p.z());
    out += fmt::format("    orientation: {{w: {}, xyz: [{}, {}, {}]}}\n", q.w(), q.x(), q.y(), q.z());
    out += fmt::format("    cspace_position: {}\n", joints_yaml(grasp.grasp_joints));
    out += fmt::format("    pregrasp_cspace_position: {}\n", joints_yaml(grasp.pregrasp_joints));
  }
  return out;
}

}  // namespace eigengrasp
