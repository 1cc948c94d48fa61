// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/kinematics/hand_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace eigengrasp {

namespace {

template <typename Item>
int find_named(const std::vector<Item>& items, const std::string& name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  return -1;
}

template <typename Member>
VecX gather(const std::vector<HandDof>& dofs, Member member) {
  VecX values(static_cast<Eigen::Index>(dofs.size()));
  for (std::size_t d = 0; d < dofs.size(); ++d) values[static_cast<Eigen::Index>(d)] = dofs[d].*member;
  return values;
}

void require(bool holds, const std::string& sentence) {
  if (!holds) throw std::logic_error("hand model: " + sentence);
}

bool is_unit(const Vec3& v) {
  return std::abs(v.norm() - 1.0) < 1e-9;
}

bool is_rigid(const Pose& X) {
  return X.matrix().allFinite() && (X.linear() * X.linear().transpose() - Mat3::Identity()).norm() < 1e-6 &&
         X.linear().determinant() > 0.0;
}

void check_joint(const HandModel& hand, int j) {
  const HandJoint& joint = hand.joints[static_cast<std::size_t>(j)];
  const std::string what = fmt::format("joint {} (\"{}\"): ", j, joint.name);
  require(joint.parent_link >= 0 && joint.parent_link <= j, what + "its parent link stands after it");
  require(is_rigid(joint.X_PJ), what + "its pose is no rigid motion");
  if (joint.type == JointType::fixed) {
    require(joint.dof == -1, what + "it is fixed but has a degree of freedom");
    return;
  }
  require(joint.dof >= 0 && joint.dof < hand.n_dof(), what + "its degree of freedom does not exist");
  require(is_unit(joint.axis_J), what + "its axis is not a unit vector");
  require(std::isfinite(joint.ratio) && std::isfinite(joint.offset), what + "its coupling is not finite");
  require(std::isfinite(joint.min) && std::isfinite(joint.max) && joint.min <= joint.max,
          what + "its limits are not finite or in the wrong order");
}

void check_dof(const HandDof& dof) {
  const std::string what = fmt::format("degree of freedom \"{}\": ", dof.name);
  require(std::isfinite(dof.min) && std::isfinite(dof.max) && dof.min <= dof.max,
          what + "its limits are not finite or in the wrong order");
  require(std::isfinite(dof.rest) && std::isfinite(dof.closing_speed), what + "a value is not finite");
}

void check_mesh(const HandLink& link) {
  const auto n = static_cast<std::int32_t>(link.mesh.vertices.size());
  for (const auto& triangle : link.mesh.triangles)
    for (const std::int32_t v : triangle)
      require(v >= 0 && v < n, fmt::format("link \"{}\": a triangle indexes beyond the vertices", link.name));
  for (const Vec3& p : link.mesh.vertices)
    require(p.allFinite(), fmt::format("link \"{}\": a vertex is not finite", link.name));
  require(std::isfinite(link.mass), fmt::format("link \"{}\": its mass is not finite", link.name));
}

/// First link of the rigid body that every link belongs to: links joined by fixed joints are one body.
std::vector<int> bodies_of_links(const HandModel& hand) {
  std::vector<int> body(hand.links.size(), 0);
  for (std::size_t j = 0; j < hand.joints.size(); ++j) {
    const bool fixed = hand.joints[j].type == JointType::fixed;
    body[j + 1] =
        fixed ? body[static_cast<std::size_t>(hand.joints[j].parent_link)] : static_cast<int>(j + 1);
  }
  return body;
}

/// Of every body (indexed by its first link), the next one with geometry towards the base; -1 for none.
std::vector<int> next_bodies_up(const HandModel& hand, const std::vector<int>& body) {
  std::vector<bool> solid(hand.links.size(), false);
  for (std::size_t i = 0; i < hand.links.size(); ++i)
    if (!hand.links[i].mesh.empty()) solid[static_cast<std::size_t>(body[i])] = true;
  std::vector<int> next(hand.links.size(), -1);
  for (std::size_t i = 1; i < hand.links.size(); ++i) {
    if (body[i] != static_cast<int>(i)) continue;
    const auto parent = static_cast<std::size_t>(hand.joints[i - 1].parent_link);
    const int above = body[parent];
    next[i] = solid[static_cast<std::size_t>(above)] ? above : next[static_cast<std::size_t>(above)];
  }
  return next;
}

}  // namespace

VecX HandModel::dof_min() const {
  return gather(dofs, &HandDof::min);
}
VecX HandModel::dof_max() const {
  return gather(dofs, &HandDof::max);
}
VecX HandModel::rest_posture() const {
  return gather(dofs, &HandDof::rest);
}

std::vector<std::string> HandModel::dof_names() const {
  std::vector<std::string> names;
  for (const HandDof& dof : dofs) names.push_back(dof.name);
  return names;
}

int HandModel::find_link(const std::string& link_name) const {
  return find_named(links, link_name);
}
int HandModel::find_joint(const std::string& joint_name) const {
  return find_named(joints, joint_name);
}
int HandModel::find_frame(const std::string& frame_name) const {
  return find_named(frames, frame_name);
}

void set_collision_pairs(HandModel& hand, const std::vector<std::array<int, 2>>& ignored) {
  const std::vector<int> body = bodies_of_links(hand);
  const std::vector<int> next = next_bodies_up(hand, body);
  std::set<std::array<int, 2>> skip;
  for (const auto& [a, b] : ignored) skip.insert({std::min(a, b), std::max(a, b)});
  hand.collision_pairs.clear();
  for (int b = 1; b < hand.n_links(); ++b) {
    if (hand.links[static_cast<std::size_t>(b)].mesh.empty()) continue;
    for (int a = 0; a < b; ++a) {
      if (hand.links[static_cast<std::size_t>(a)].mesh.empty() || skip.contains({a, b})) continue;
      const int body_a = body[static_cast<std::size_t>(a)];
      const int body_b = body[static_cast<std::size_t>(b)];
      const bool neighbours = body_a == body_b || next[static_cast<std::size_t>(body_a)] == body_b ||
                              next[static_cast<std::size_t>(body_b)] == body_a;
      if (!neighbours) hand.collision_pairs.push_back({a, b});
    }
  }
  std::sort(hand.collision_pairs.begin(), hand.collision_pairs.end());
}

void check_invariants(const HandModel& hand) {
  require(!hand.links.empty(), "it has no links");
  require(hand.joints.size() + 1 == hand.links.size(), "it must have one joint fewer than links");
  for (int j = 0; j < hand.n_joints(); ++j) check_joint(hand, j);
  for (const HandDof& dof : hand.dofs) check_dof(dof);
  for (const HandLink& link : hand.links) check_mesh(link);
  for (const HandFrame& frame : hand.frames) {
    require(frame.link >= 0 && frame.link < hand.n_links(), "frame \"" + frame.name + "\" has no link");
    require(is_rigid(frame.X_LF), "frame \"" + frame.name + "\": its pose is no rigid motion");
  }
  for (const VirtualContact& c : hand.virtual_contacts) {
    require(c.link >= 0 && c.link < hand.n_links(), "a virtual contact has no link");
    require(c.p_LC.allFinite() && is_unit(c.n_LC), "a virtual contact has no finite point or unit normal");
  }
  for (const auto& [a, b] : hand.collision_pairs)
    require(a >= 0 && a < b && b < hand.n_links(), "a collision pair is not two links in order");
  require(hand.approach_point_H.allFinite() && is_unit(hand.approach_direction_H),
          "the approach has no finite point or unit direction");
  require(hand.eigengrasps.n_dof() == hand.n_dof(),
          "its eigengrasps have another number of degrees of freedom");
}

}  // namespace eigengrasp
