// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <vector>

#include "eigengrasp/geometry/mesh_motion.hpp"
#include "eigengrasp/geometry/sphere_cover.hpp"

namespace eigengrasp {

/// Spheres that come near all of a surface, as its inner spheres do, each made larger until together they
/// hold it: by what they miss of it, and 1 mm at most. No spheres: none. Cost: 1 us a triangle, and for large
/// ones a square millimetre.
std::vector<Sphere> grow_to_hold(const MeshBvh& surface, std::vector<Sphere> spheres);

/// Balls that together hold all of a surface, see grow_to_hold. They tell at once, though not sharply, for
/// how long the surface stays away from another that is at rest: what is looked at first while the two are
/// some millimetres apart. A cheap value; immutable, any number of threads.
class BallCover {
 public:
  BallCover() = default;
  explicit BallCover(std::vector<Sphere> spheres);

  bool empty() const { return packs_ == nullptr; }
  /// Lower bound [s] of the time for which all of the surface stays farther than `margin` [m] from the
  /// surface of the field.
  /// @param X_FB the balls' surface in the frame of the field  @param motion in the frame of the field; that
  /// of b moves these balls  @param enough [s] where it is sure to be longer than this it need not be sharp
  /// @param too_little [s] where it is found to be shorter than this the search ends
  /// Cost: 0.1-2 us. @pre the field's surface is at rest: motion.of_a is empty; not more than 32 joints
  double free_time(const DistanceField& field, const Pose& X_FB, const SurfaceMotion& motion, double margin,
                   double enough, double too_little = 0.0) const;

  /// Whether all of the surface is sure to be farther than `distance` [m] from the surface of the field.
  /// False says nothing. Cost and parameters as above.
  bool keeps_away(const DistanceField& field, const Pose& X_FB, double distance) const {
    constexpr double any = 1e-12;  // [s] what is at rest stays where it is
    return free_time(field, X_FB, {}, distance, any, any) > 0.0;
  }

 private:
  struct Packs;
  std::shared_ptr<const Packs> packs_;
};

}  // namespace eigengrasp
