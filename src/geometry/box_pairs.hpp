// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/geometry/mesh_motion.hpp"
#include "geometry/kernel/box_looks.hpp"

namespace eigengrasp::detail {

/// Oriented boxes of two surfaces, looked at in packs of up to sixteen pairs of nodes.
class BoxPairs {
 public:
  static constexpr int most = kernel::n_lanes;

  /// b is posed in the frame of a. @pre neither is empty
  BoxPairs(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB);
  BoxPairs(const BoxPairs&) = delete;
  BoxPairs& operator=(const BoxPairs&) = delete;

  /// From here on pairs are looked at for times too. @param margin [m]
  void set_motion(const SurfaceMotion& motion, double margin);

  void clear() { n_ = 0; }
  int size() const { return n_; }
  /// @pre size() < most
  void add(int node_a, int node_b) {
    pairs_.a[n_] = node_a;
    pairs_.b[n_] = node_b;
    ++n_;
  }

  void look_at_gaps() { functions_.gaps(place_, pairs_); }
  /// @param outlook [s] for times of this size the bounds are best
  void look_at_times(double outlook);

  /// Lower bound [m] of the distance of what is in the two boxes; negative where they overlap along the axes
  /// of both. After a look.
  float gap(int pair) const { return pairs_.gap[pair]; }
  /// Time [s] for which it is sure to stay farther apart than the margin. After look_at_times.
  double time(int pair) const { return pairs_.time[pair]; }

  /// A ball about a box of b, in the frame of a.
  struct Ball {
    Vec3 center;
    double radius;
  };
  Ball ball(int node_b) const {
    const MeshBvh::OrientedBox& box = b_.oriented_box(node_b);
    const Vec3 half = Vec3(box.half[0], box.half[1], box.half[2]);
    return {X_AB_ * Vec3(box.center[0], box.center[1], box.center[2]), half.norm() + place_.rounding};
  }

 private:
  const MeshBvh& b_;
  const Pose& X_AB_;
  const box_kernel::Functions& functions_;
  box_kernel::Placement place_;
  box_kernel::Motion motion_{};
  static constexpr std::size_t few = 16;
  box_kernel::Joint few_joints_[few];
  std::vector<box_kernel::Joint> many_joints_;  ///< only where there are more
  box_kernel::Pairs pairs_{};
  int n_ = 0;
};

}  // namespace eigengrasp::detail
