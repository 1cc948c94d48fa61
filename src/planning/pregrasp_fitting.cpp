// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/pregrasp_fitting.hpp"

#include <algorithm>
#include <set>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/kinematics/hand_parts.hpp"
#include "eigengrasp/planning/palm_approach.hpp"

namespace eigengrasp {

namespace {

/// A finger, or the palm.
struct Part {
  std::vector<int> links;
  std::set<int> dofs;  ///< that move it and can open; none of the palm
};

void find_opening_dofs(const HandModel& hand, Part& part) {
  for (int j = 0; j < hand.n_joints(); ++j) {
    const int dof = hand.joints[static_cast<std::size_t>(j)].dof;
    if (dof < 0 || hand.dofs[static_cast<std::size_t>(dof)].closing_speed == 0.0) continue;
    if (std::any_of(part.links.begin(), part.links.end(),
                    [&](int link) { return moves_link(hand, j, link); }))
      part.dofs.insert(dof);
  }
}

/// The palm first.
std::vector<Part> parts_of(const HandModel& hand) {
  const std::vector<int> roots = finger_roots(hand);
  std::vector<Part> parts(1);
  std::vector<std::size_t> part_of_root(hand.links.size(), 0);
  for (int i = 0; i < hand.n_links(); ++i) {
    const int root = roots[static_cast<std::size_t>(i)];
    std::size_t part = 0;
    if (root >= 0) {
      if (root == i) {
        part_of_root[static_cast<std::size_t>(root)] = parts.size();
        parts.emplace_back();
      }
      part = part_of_root[static_cast<std::size_t>(root)];
    }
    parts[part].links.push_back(i);
  }
  for (std::size_t p = 1; p < parts.size(); ++p) find_opening_dofs(hand, parts[p]);
  return parts;
}

class Fitting {
 public:
  Fitting(const CollisionModel& model, const Pose& X_OH, const VecX& dofs, const FittingOptions& options)
      : model_(model),
        hand_(*model.scene().hand),
        options_(options),
        parts_(parts_of(hand_)),
        direction_O_(X_OH.linear() * hand_.approach_direction_H) {
    fitted_.X_OH = X_OH;
    fitted_.dofs = clamp_posture(hand_, dofs);
    pose_links();
  }

  FittedPreGrasp run() {
    if (!back_off(1)) return fitted_;
    for (std::size_t p = 1; p < parts_.size(); ++p) open(parts_[p]);
    if (!back_off(parts_.size())) return fitted_;
    fitted_.free = true;
    fitted_.X_OH_free = fitted_.X_OH;
    move_forwards();
    return fitted_;
  }

 private:
  void pose_links() { compute_link_poses(hand_, joint_values(hand_, fitted_.dofs), fitted_.X_OH, X_OL_); }
  bool link_hits(int link) const;
  bool hits(const Part& part) const {
    return std::any_of(part.links.begin(), part.links.end(), [this](int link) { return link_hits(link); });
  }
  bool back_off(std::size_t n_parts);
  void open(const Part& part);
  bool open_a_step(const Part& part);
  void move_forwards();

  const CollisionModel& model_;
  const HandModel& hand_;
  const FittingOptions& options_;
  std::vector<Part> parts_;
  Vec3 direction_O_;
  std::vector<Pose> X_OL_;
  FittedPreGrasp fitted_;
};

bool Fitting::link_hits(int link) const {
  if (model_.surfaces().links[static_cast<std::size_t>(link)].empty()) return false;
  const Pose& X_OL = X_OL_[static_cast<std::size_t>(link)];
  const auto overlap = model_.overlap_with_object(link, X_OL);
  if (overlap.crosses || overlap.contained) return true;
  for (int k = 0; k < static_cast<int>(model_.scene().obstacles.size()); ++k)
    if (model_.distance_to_obstacle(k, link, X_OL, options_.contact_gap) <= 0.0) return true;
  return false;
}

/// Until the first n parts are free; false where the way back ends.
bool Fitting::back_off(std::size_t n_parts) {
  const auto end = parts_.begin() + static_cast<std::ptrdiff_t>(n_parts);
  while (std::any_of(parts_.begin(), end, [this](const Part& part) { return hits(part); })) {
    if (fitted_.backwards >= options_.most_back) return false;
    fitted_.backwards += options_.back_step;
    fitted_.X_OH.translation() -= options_.back_step * direction_O_;
    pose_links();
  }
  return true;
}

/// False where all degrees of freedom are open.
bool Fitting::open_a_step(const Part& part) {
  bool moved = false;
  for (const int d : part.dofs) {
    const HandDof& dof = hand_.dofs[static_cast<std::size_t>(d)];
    const double step = options_.open_step * (dof.max - dof.min);
    const double before = fitted_.dofs[d];
    fitted_.dofs[d] =
        dof.closing_speed > 0.0 ? std::max(dof.min, before - step) : std::min(dof.max, before + step);
    moved = moved || fitted_.dofs[d] != before;
  }
  if (moved) pose_links();
  return moved;
}

void Fitting::open(const Part& part) {
  while (hits(part))
    if (!open_a_step(part)) return;
}

void Fitting::move_forwards() {
  const ObjectModel& object = *model_.scene().object;
  const Vec3 to_center = object.center_of_mass - fitted_.X_OH * hand_.approach_point_H;
  const PalmApproach approach =
      approach_until_contact(model_, fitted_.X_OH, joint_values(hand_, fitted_.dofs),
                             to_center.norm() + object.max_radius, options_.contact_gap);
  if (!approach.touches) return;
  fitted_.touches = true;
  fitted_.forwards = approach.travel;
  fitted_.X_OH = approach.X_OH;
}

}  // namespace

FittedPreGrasp fit_pregrasp(const CollisionModel& model, const Pose& X_OH, const VecX& dofs,
                            const FittingOptions& options) {
  return Fitting(model, X_OH, dofs, options).run();
}

}  // namespace eigengrasp
