// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// From the elements of a URDF to a tree of joints whose couplings are resolved.
#include "eigengrasp/core/error.hpp"
#include "model_io/text_values.hpp"
#include "model_io/urdf_reader.hpp"

namespace eigengrasp {

namespace {

std::map<std::string, int> index_links(const Urdf& urdf) {
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < urdf.links.size(); ++i) index[urdf.links[i].name] = static_cast<int>(i);
  return index;
}

std::vector<std::string> link_names(const Urdf& urdf) {
  std::vector<std::string> names;
  for (const UrdfLink& link : urdf.links) names.push_back(link.name);
  return names;
}

std::vector<std::string> joint_names(const Urdf& urdf) {
  std::vector<std::string> names;
  for (const UrdfJoint& joint : urdf.joints) names.push_back(joint.name);
  return names;
}

int require_link(const Urdf& urdf, const std::map<std::string, int>& index, const UrdfJoint& joint,
                 const char* role, const std::string& name) {
  const auto found = index.find(name);
  if (found == index.end()) {
    fail_at(urdf.file, joint.line, "joint {}: the {} link is \"{}\", expected a link of the file{}",
            joint.name, role, shown(name), did_you_mean(name, link_names(urdf)));
  }
  return found->second;
}

/// Of every link the joint above it, -1 for a root; and below every link its joints, in order.
struct Tree {
  std::vector<int> above;
  std::vector<std::vector<int>> below;
};

Tree connect(const Urdf& urdf, const std::map<std::string, int>& index) {
  Tree tree{std::vector<int>(urdf.links.size(), -1), std::vector<std::vector<int>>(urdf.links.size())};
  for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
    const UrdfJoint& joint = urdf.joints[j];
    const int parent = require_link(urdf, index, joint, "parent", joint.parent);
    const int child = require_link(urdf, index, joint, "child", joint.child);
    int& above = tree.above[static_cast<std::size_t>(child)];
    if (above >= 0) {
      const UrdfJoint& other = urdf.joints[static_cast<std::size_t>(above)];
      fail_at(
          urdf.file, joint.line,
          "joint {}: its child link \"{}\" hangs on joint {} already (line {}), expected one joint a link",
          joint.name, joint.child, other.name, other.line);
    }
    above = static_cast<int>(j);
    tree.below[static_cast<std::size_t>(parent)].push_back(static_cast<int>(j));
  }
  return tree;
}

int find_root(const Urdf& urdf, const Tree& tree) {
  int root = -1;
  for (std::size_t i = 0; i < urdf.links.size(); ++i) {
    if (tree.above[i] >= 0) continue;
    if (root >= 0) {
      fail_at(
          urdf.file, urdf.links[i].line,
          "the links \"{}\" and \"{}\" both have no joint above them, expected one root (join them with a "
          "joint of type fixed)",
          urdf.links[static_cast<std::size_t>(root)].name, urdf.links[i].name);
    }
    root = static_cast<int>(i);
  }
  if (root < 0) {
    fail_at(urdf.file, urdf.joints.front().line,
            "every link has a joint above it, so the joints make a cycle, expected one root link");
  }
  return root;
}

int find_joint(const Urdf& urdf, const std::string& name) {
  for (std::size_t j = 0; j < urdf.joints.size(); ++j)
    if (urdf.joints[j].name == name) return static_cast<int>(j);
  return -1;
}

/// The joint that a mimic names. @throws Error where it is unknown or fixed.
int require_driver(const Urdf& urdf, const UrdfJoint& joint) {
  const int driver = find_joint(urdf, joint.mimic->joint);
  if (driver < 0) {
    fail_at(urdf.file, joint.line, "joint {}: mimics \"{}\", expected a joint of the file{}", joint.name,
            shown(joint.mimic->joint), did_you_mean(joint.mimic->joint, joint_names(urdf)));
  }
  if (urdf.joints[static_cast<std::size_t>(driver)].type == JointType::fixed) {
    fail_at(urdf.file, joint.line, "joint {}: mimics \"{}\", which is fixed, expected a joint that moves",
            joint.name, joint.mimic->joint);
  }
  return driver;
}

}  // namespace

std::vector<int> order_joints(const Urdf& urdf, int& root) {
  const auto index = index_links(urdf);
  const Tree tree = connect(urdf, index);
  root = find_root(urdf, tree);
  std::vector<int> order;
  const auto& first = tree.below[static_cast<std::size_t>(root)];
  std::vector<int> open(first.rbegin(), first.rend());
  std::vector<bool> reached(urdf.joints.size(), false);
  while (!open.empty()) {
    const int j = open.back();
    open.pop_back();
    order.push_back(j);
    reached[static_cast<std::size_t>(j)] = true;
    const auto& next =
        tree.below[static_cast<std::size_t>(index.at(urdf.joints[static_cast<std::size_t>(j)].child))];
    open.insert(open.end(), next.rbegin(), next.rend());
  }
  for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
    if (!reached[j]) {
      fail_at(
          urdf.file, urdf.joints[j].line,
          "joint {}: is part of a cycle of joints that does not reach the root link \"{}\", expected a tree",
          urdf.joints[j].name, urdf.links[static_cast<std::size_t>(root)].name);
    }
  }
  return order;
}

std::vector<std::optional<UrdfMimic>> resolve_mimics(const Urdf& urdf) {
  std::vector<std::optional<UrdfMimic>> resolved(urdf.joints.size());
  for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
    const UrdfJoint& joint = urdf.joints[j];
    if (joint.type == JointType::fixed || !joint.mimic) continue;
    UrdfMimic total = *joint.mimic;
    int driver = require_driver(urdf, joint);
    for (std::size_t steps = 0; urdf.joints[static_cast<std::size_t>(driver)].mimic; ++steps) {
      const UrdfJoint& next = urdf.joints[static_cast<std::size_t>(driver)];
      if (steps > urdf.joints.size() || next.name == joint.name) {
        fail_at(urdf.file, joint.line,
                "joint {}: mimics \"{}\", which comes back to itself, expected a joint "
                "that moves on its own",
                joint.name, joint.mimic->joint);
      }
      driver = require_driver(urdf, next);
      total = {next.mimic->joint, total.multiplier * next.mimic->multiplier,
               total.multiplier * next.mimic->offset + total.offset};
    }
    resolved[j] = total;
  }
  return resolved;
}

}  // namespace eigengrasp
