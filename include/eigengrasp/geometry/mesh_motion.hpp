// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>

#include "eigengrasp/geometry/distance_field.hpp"

namespace eigengrasp {

/// Velocity field of a rigid body: a point x moves at linear + angular x x. For one joint of a chain.
struct Screw {
  Vec3 angular = Vec3::Zero();  ///< [rad/s]
  Vec3 linear = Vec3::Zero();   ///< of the point at the frame's origin [m/s]

  Vec3 velocity(const Vec3& x) const { return linear + angular.cross(x); }
};

/// How two surfaces move, in a frame at rest that is the frame of a at time 0: each joint moves one way and
/// may stop at any time.
struct SurfaceMotion {
  std::span<const Screw> of_a;  ///< the joints that move a, as they do at time 0
  std::span<const Screw> of_b;
  double acceleration = 0.0;  ///< [m/s^2] that no point of a and no point of b ever exceed together, whatever
                              ///< joints have stopped
  bool still() const { return of_a.empty() && of_b.empty(); }
};

/// Time for which two surfaces are sure to stay apart.
struct FreeTime {
  double time = 0.0;  ///< [s]
  /// Distance [m] at time 0 of the two triangles that limit the time; infinite where none does. 0: they
  /// cross.
  double distance = std::numeric_limits<double>::infinity();
};

/// Lower bound of the time that both can move before any triangle of b comes nearer to one of a than
/// min(margin, half of their present distance), and at most `horizon` [s]: 0 only where the surfaces cross.
/// The bound is sharp to first order: of every two triangles the plane between their nearest points, or that
/// of one of them, tells how fast they come together, so that what slides past or parts is no hindrance.
/// @param margin [m] @param hint the triangles that limited an earlier time: where to look first
/// @param field of surface a, or empty: saves most of the search, does not change the bound's validity
/// @param touching where the hint's triangles are at most so far apart [m], the search ends with them: their
/// distance is right then, the time is not a bound
/// Cost: 1-20 us.
FreeTime compute_free_time(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                           double margin, double horizon, PairHint* hint = nullptr,
                           const DistanceField& field = {}, double touching = -1.0);

/// The same for whole parts of b and the field of a resting surface alone: a small share of the cost, and a
/// much lower bound for what is nearer than about three cells.
double compute_rough_free_time(const DistanceField& field, const MeshBvh& b, const Pose& X_AB,
                               const SurfaceMotion& motion, double margin, double horizon);

/// The same for a few boxes about parts of two surfaces, posed in the frame of the motion: 0.2-3 us.
/// @param enough [s] boxes that are free so long are not divided
double compute_rough_free_time(const MeshBvh& a, const Pose& X_OA, const MeshBvh& b, const Pose& X_OB,
                               const SurfaceMotion& motion, double margin, double enough);

/// Certain lower bound [m] of the distance from p to the surface of which the field is; may be negative. A
/// value between grid nodes is off by less than sqrt(3)/2 of a cell, and at n cells from the surface by less
/// than 3/8 / (n - 3) of one.
double certain_distance(const DistanceField& field, const Vec3& p);

/// Time in which a gap [m] that closes at `rate` [m/s] at first, and ever faster by at most `acceleration`,
/// is used up; infinite where it never is.
double time_to_close(double gap, double rate, double acceleration);

}  // namespace eigengrasp
