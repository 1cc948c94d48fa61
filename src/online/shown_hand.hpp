// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/online/online_planner.hpp"

namespace eigengrasp {

/// The hand that the operator sees: follows the wrist, takes the posture of the offered grasp as it comes
/// near ("as the real hand position approaches the target grasp, the fingers are gradually closed"), and is
/// free of collision by exact meshes at every moment. Not safe to share without a lock.
class ShownHand {
 public:
  ShownHand(const CollisionModel& model, const OnlineOptions& options);

  /// @param X_OW_held wrist as the operator holds it; tremor below 2.5 mm is averaged away, and a wrist that
  ///        near to the offered pre-grasp is shown at it
  /// @param offered pre-grasp to take the posture of; null: open
  /// @param seconds since the last call: the fingers move no faster than they can. Cost: 0.1-1 ms
  void follow(const Pose& X_OW_held, const Grasp* offered, double seconds);
  /// Stands as the grasp does / as its pre-grasp does.
  void hold(const Grasp& grasp);
  void let_go(const Grasp& grasp);

  const Pose& X_OH() const { return X_OH_; }
  const VecX& dofs() const { return dofs_; }
  VecX joints() const;
  bool blocked() const { return blocked_; }
  double preshape() const { return preshape_; }
  const std::vector<Pose>& X_OL() const { return X_OL_; }

 private:
  Pose steady(const Pose& X_OW, double seconds) const;
  bool is_free(const Pose& X_OH, const VecX& dofs);
  bool find_free_start(const Pose& X_OW);
  VecX preshaped(const VecX& pregrasp) const;
  VecX towards(const VecX& wanted, double seconds) const;
  void go_as_far_as_free(const Pose& X_OW);
  bool draw_back(const Pose& X_OW, const VecX& moved);
  void move(const Pose& X_OW, const VecX& moved, const VecX& opened);

  const CollisionModel& model_;
  const OnlineOptions& options_;
  VecX open_;
  bool placed_ = false;             ///< somewhere free
  Pose steady_ = Pose::Identity();  ///< the wrist without its tremor
  Pose X_OH_ = Pose::Identity();
  VecX dofs_;
  VecX joints_;  ///< where break-away has parted them from dofs_; else empty
  bool blocked_ = false;
  double preshape_ = 0.0;
  std::vector<Pose> X_OL_;
};

}  // namespace eigengrasp
