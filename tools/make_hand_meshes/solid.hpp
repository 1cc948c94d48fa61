// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <vector>

#include "eigengrasp/core/pose.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp::shapes {

/// A body as a distance function [m]: negative inside, zero on the surface, of slope about 1 near it.
/// bounds holds the whole body.
struct Solid {
  std::function<double(const Vec3&)> distance;
  Box bounds;
};

/// Box of the given size about the origin, edges rounded inwards with radius round [m].
Solid make_box(const Vec3& size, double round);

/// Cylinder about the z axis, centred on the origin, edges rounded inwards.
Solid make_cylinder(double radius, double height, double round);

/// Ball of radius r1 at p1 and of radius r2 at p2 with the hull between them (a capsule where r1 = r2).
Solid make_round_cone(const Vec3& p1, double r1, const Vec3& p2, double r2);

/// Ellipsoid about the origin.
Solid make_ellipsoid(const Vec3& radii);

/// A closed polygon in the xy plane given height along z about z = 0, all edges rounded with radius round.
/// @pre at least three corners, no crossing edges
Solid make_plate(const std::vector<Eigen::Vector2d>& outline, double height, double round);

/// Cross-section of a loft: a superellipse of four quarters about a centre, from lo to hi along its own y and
/// z, which are turned by roll about the centre.
struct LoftSection {
  double at = 0.0;                                   ///< place along the x axis [m]
  Eigen::Vector2d lo = Eigen::Vector2d::Zero();      ///< lowest y and z [m]
  Eigen::Vector2d hi = Eigen::Vector2d::Zero();      ///< highest y and z [m]
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< where the quarters meet; within lo..hi
  double power = 2.0;                                ///< 2: ellipse; towards 8: box
  double roll = 0.0;  ///< the section turned about the spine, y towards z [rad]
};

/// Body through sections along the x axis, smooth between them; its ends are domes of length caps[0] and
/// caps[1].
/// @pre at least two sections, at ascending, lo < center < hi, power >= 1
Solid make_loft(const std::vector<LoftSection>& sections, const std::array<double, 2>& caps);

/// The body carried by X.
Solid moved(Solid a, const Pose& X);

/// a or b; the seam is filled with a fillet of about radius blend.
Solid united(Solid a, Solid b, double blend);

/// a without b; the edge is broken with about radius blend.
Solid subtracted(Solid a, Solid b, double blend);

/// What a and b share.
Solid intersected(Solid a, Solid b, double blend);

/// Unit vector of steepest ascent of the distance, by central differences.
Vec3 outward_normal(const Solid& solid, const Vec3& p);

/// Walks p along the gradient onto the surface; p must be close to it.
Vec3 project_to_surface(const Solid& solid, Vec3 p);

}  // namespace eigengrasp::shapes
