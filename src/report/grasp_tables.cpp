// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/report/grasp_tables.hpp"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/kinematics/hand_parts.hpp"

namespace eigengrasp {

namespace {

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

void append_pose(const Pose& X, std::vector<std::string>& row) {
  const Eigen::Quaterniond q = orientation(X);
  for (const double v :
       {X.translation().x(), X.translation().y(), X.translation().z(), q.w(), q.x(), q.y(), q.z()})
    row.push_back(fmt::format("{}", v));
}

std::vector<std::string> csv_headings(const Grasp& first) {
  std::vector<std::string> row = {"rank",   "hand",   "object",       "object_scale", "epsilon",
                                  "volume", "energy", "form_closure", "contacts",     "max_penetration"};
  for (const char* phase : {"pregrasp", "grasp"})
    for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz"})
      row.push_back(fmt::format("{}_{}", phase, part));
  for (const auto& [name, value] : first.pregrasp_joints) row.push_back(fmt::format("pregrasp:{}", name));
  for (const auto& [name, value] : first.grasp_joints) row.push_back(fmt::format("grasp:{}", name));
  return row;
}

std::string value_of(const NamedValues& values, const std::string& name) {
  for (const auto& [n, value] : values)
    if (n == name) return fmt::format("{}", value);
  return "";
}

std::vector<std::string> csv_row(const Grasp& grasp, const Grasp& first, std::size_t rank) {
  std::vector<std::string> row = {fmt::format("{}", rank),
                                  grasp.hand,
                                  grasp.object,
                                  fmt::format("{}", grasp.object_scale),
                                  fmt::format("{}", grasp.epsilon),
                                  fmt::format("{}", grasp.volume),
                                  fmt::format("{}", grasp.energy),
                                  grasp.form_closure ? "true" : "false",
                                  fmt::format("{}", grasp.contacts.size()),
                                  fmt::format("{}", grasp.max_penetration)};
  append_pose(grasp.X_OH_pregrasp, row);
  append_pose(grasp.X_OH, row);
  for (const auto& [name, value] : first.pregrasp_joints)
    row.push_back(value_of(grasp.pregrasp_joints, name));
  for (const auto& [name, value] : first.grasp_joints) row.push_back(value_of(grasp.grasp_joints, name));
  return row;
}

void append_csv(const std::vector<std::string>& row, std::string& out) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) out += ',';
    out += csv_text(row[i]);
  }
  out += "\r\n";
}

}  // namespace

TouchingParts touching_parts(const HandModel& hand, const Grasp& grasp) {
  const std::vector<int> roots = finger_roots(hand);
  TouchingParts parts;
  std::set<int> fingers;
  for (const GraspContact& contact : grasp.contacts) {
    const int link = hand.find_link(contact.link);
    if (link < 0) continue;
    const int root = roots[static_cast<std::size_t>(link)];
    if (root < 0)
      parts.palm = true;
    else
      fingers.insert(root);
  }
  parts.fingers = static_cast<int>(fingers.size());
  return parts;
}

std::string grasps_table(const HandModel& hand, std::span<const Grasp> grasps, int rows) {
  std::string table = fmt::format("{:>4}  {:>8}  {:>9}  {:>9}  {:>8}  {:>10}  {:>6}\n", "rank", "epsilon",
                                  "volume", "energy", "contacts", "fingers", "closed");
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    if (rows > 0 && i >= static_cast<std::size_t>(rows)) break;
    const Grasp& grasp = grasps[i];
    const TouchingParts parts = touching_parts(hand, grasp);
    table += fmt::format("{:>4}  {:>8.4f}  {:>9.2e}  {:>9.3f}  {:>8}  {:>10}  {:>6}\n", i + 1, grasp.epsilon,
                         grasp.volume, grasp.energy, grasp.contacts.size(),
                         fmt::format("{}{}", parts.fingers, parts.palm ? " + palm" : ""),
                         grasp.form_closure ? "yes" : "no");
  }
  return table;
}

std::string grasps_csv(std::span<const Grasp> grasps) {
  const Grasp none;
  const Grasp& first = grasps.empty() ? none : grasps.front();
  std::string out;
  append_csv(csv_headings(first), out);
  for (std::size_t i = 0; i < grasps.size(); ++i) append_csv(csv_row(grasps[i], first, i + 1), out);
  return out;
}

void save_grasps_csv(std::span<const Grasp> grasps, const std::filesystem::path& path) {
  write_file_atomically(path, grasps_csv(grasps));
}

}  // namespace eigengrasp
