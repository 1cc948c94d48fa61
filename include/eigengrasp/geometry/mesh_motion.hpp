// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>
#include <vector>

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
/// Cost: 1-100 us.
FreeTime compute_free_time(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion,
                           double margin, double horizon, PairHint* hint = nullptr);

/// The same two surfaces looked at again and again while they move. Kept between looks are pairs of parts
/// that together hold all pairs of triangles, each with the time up to which it is sure to stay apart: a look
/// only goes on with those for which the next free time would be too long.
class SeparationFront {
 public:
  /// Free time from time `now` [s] on: as valid as that of compute_free_time, of which it may differ a little
  /// since it depends on earlier looks.
  /// @param field of surface a, which then is at rest, or empty: saves much of the search
  /// @param touching where the triangles that limited the last time are at most so far apart [m], the search
  /// ends with them: their distance is right then, the time is not a bound, and nothing else is changed
  /// @pre the surfaces and the field are those of the first look; now is not less than at the last look; up
  /// to now they stayed farther apart than the margin, by free_until() or as is known otherwise; no joint has
  /// begun or quickened its motion since the first look, and the acceleration holds for all that is to come.
  /// Cost: 1-20 us, the first look 1-100 us.
  FreeTime look(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const SurfaceMotion& motion, double now,
                double margin, double horizon, const DistanceField& field = {}, double touching = -1.0);

  /// Time [s] up to which the surfaces are sure to stay apart: not less than now + time of the last look, and
  /// not bound by its horizon. 0 before the first.
  double free_until() const { return free_until_; }

  /// Distance [m] that the surfaces are sure to keep up to free_until(): more than 0 where they did not cross
  /// at any look. 0 before the first.
  double clearance() const { return clearance_; }

  /// As the function of that name, in another order: goes on with the parts that are kept, or with the whole
  /// surfaces before the first look. The pose may be any. @param field of surface a, or empty
  void for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                            const DistanceField& field,
                            const std::function<void(const ClosestPair&)>& visit) const;

  /// The triangles that limited the last time that any limited; -1 before.
  const PairHint& nearest() const { return nearest_; }

  /// A node of each surface's hierarchy and the time [s] up to which they stay apart.
  struct Parts {
    int a;  ///< -1: the whole surface, of which the field tells
    int b;
    double until;
  };

 private:
  std::vector<Parts> parts_;
  PairHint nearest_;
  double free_until_ = 0.0;
  double clearance_ = 0.0;
};

/// As intersects of the two hierarchies. @param field of surface a: keeps far parts of b away, which saves
/// much of the search
bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const DistanceField& field);

/// Certain lower bound [m] of the distance from p to the surface of which the field is; may be negative. A
/// value between grid nodes is off by less than sqrt(3)/2 of a cell, and at n cells from the surface by less
/// than 3/8 / (n - 3) of one.
double certain_distance(const DistanceField& field, const Vec3& p);

/// Time in which a gap [m] that closes at `rate` [m/s] at first, and ever faster by at most `acceleration`,
/// is used up; infinite where it never is.
double time_to_close(double gap, double rate, double acceleration);

}  // namespace eigengrasp
