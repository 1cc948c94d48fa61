// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/render/pictures.hpp"

namespace eigengrasp {

namespace {

/// Links from the base to the first one that carries several fingers, that one included.
std::vector<bool> trunk_links(const HandModel& hand) {
  std::vector<std::vector<int>> children(hand.links.size());
  for (int j = 0; j < hand.n_joints(); ++j)
    children[static_cast<std::size_t>(hand.joints[static_cast<std::size_t>(j)].parent_link)].push_back(j + 1);
  std::vector<bool> trunk(hand.links.size(), false);
  int link = 0;
  for (;;) {
    trunk[static_cast<std::size_t>(link)] = true;
    const auto& next = children[static_cast<std::size_t>(link)];
    if (next.size() != 1) return trunk;
    link = next.front();
  }
}

std::vector<bool> leaf_links(const HandModel& hand) {
  std::vector<bool> leaf(hand.links.size(), true);
  for (const HandJoint& joint : hand.joints) leaf[static_cast<std::size_t>(joint.parent_link)] = false;
  return leaf;
}

}  // namespace

DrawnHand::DrawnHand(std::shared_ptr<const HandModel> hand)
    : hand_(std::move(hand)), is_base_(trunk_links(*hand_)) {
  for (const HandLink& link : hand_->links)
    surfaces_.push_back(link.mesh.empty() ? nullptr : make_surface(link.mesh));
}

void DrawnHand::add_to(RenderScene& scene, const VecX& joints, const Pose& X_WH, const Palette& palette,
                       float alpha) const {
  std::vector<Pose> X_WL;
  compute_link_poses(*hand_, joints, X_WH, X_WL);
  const int group = scene.new_group();
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if (!surfaces_[i]) continue;
    Color color = is_base_[i] ? palette.base : palette.hand;
    color.a *= alpha;
    RenderItem& item = scene.add(surfaces_[i], X_WL[i], color);
    item.group = group;
    item.interest = is_base_[i] ? 0.3 : 1.0;
  }
}

Vec3 finger_direction(const HandModel& hand) {
  std::vector<Pose> X_HL;
  compute_link_poses(hand, joint_values(hand, hand.rest_posture()), Pose::Identity(), X_HL);
  const std::vector<bool> trunk = trunk_links(hand);
  const std::vector<bool> leaf = leaf_links(hand);
  Box palm;
  Vec3 tips = Vec3::Zero();
  int n_tips = 0;
  for (std::size_t i = 0; i < hand.links.size(); ++i) {
    const Box box = bounding_box(hand.links[i].mesh);
    if (box.empty()) continue;
    if (trunk[i]) {
      palm.add(X_HL[i] * box.center());
    } else if (leaf[i]) {
      tips += X_HL[i] * box.center();
      ++n_tips;
    }
  }
  if (n_tips == 0 || palm.empty()) return hand.approach_direction_H;
  const Vec3 direction = tips / n_tips - palm.center();
  const bool along_approach = direction.dot(hand.approach_direction_H) > 0.7 * direction.norm();
  return along_approach || direction.norm() < 1e-3 ? hand.approach_direction_H : direction.normalized();
}

Vec3 hand_view(const HandModel& hand) {
  const Vec3 up = finger_direction(hand);
  const Vec3 across = hand.approach_direction_H - hand.approach_direction_H.dot(up) * up;
  if (across.norm() > 0.35) {
    // In front of the palm, a little to the side and above.
    const Vec3 front = across.normalized();
    const Vec3 side = up.cross(front);
    return -(0.80 * front + 0.50 * side + 0.22 * up).normalized();
  }
  RenderScene scene;
  const auto shared = std::shared_ptr<const HandModel>(std::shared_ptr<void>(), &hand);
  DrawnHand(shared).add_to(scene, joint_values(hand, hand.rest_posture()), Pose::Identity(), Palette());
  return pick_view(scene, {}, up);
}

}  // namespace eigengrasp
