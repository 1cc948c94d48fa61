// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <vector>

#include "eigengrasp/modeling/solid.hpp"

namespace eigengrasp::modeling {

/// Ball; the distance is exact.
Solid sphere(const Vec3& center, double radius);

/// Axis-aligned box of the full size `size` [m] around center, edges and corners rounded with `radius`.
/// @pre 0 <= radius <= half of the smallest size.
Solid rounded_box(const Vec3& center, const Vec3& size, double radius);

/// Ball of radius swept from a to b; exact.
Solid capsule(const Vec3& a, const Vec3& b, double radius);

/// Convex hull of two balls; exact. One ball may contain the other.
Solid round_cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b);

/// Cylinder with flat ends at a and b, rims rounded with edge_radius; exact.
/// @pre a != b, 0 <= edge_radius <= min(radius, |b - a| / 2).
Solid cylinder(const Vec3& a, const Vec3& b, double radius, double edge_radius = 0.0);

/// Ellipsoid of half axes radii along x, y, z; the distance is of first order.
Solid ellipsoid(const Vec3& center, const Vec3& radii);

/// One cross section of a sweep along x: a superellipse |y/a|^n + |z/b|^n <= 1 around (center_y, center_z),
/// where b may differ above and below the centre.
struct Section {
  double x = 0.0;           ///< station [m]
  double center_y = 0.0;    ///< [m]
  double center_z = 0.0;    ///< [m]
  double half_width = 0.0;  ///< a [m], along y
  double half_up = 0.0;     ///< b [m] for z above the centre
  double half_down = 0.0;   ///< b [m] for z below the centre
  double exponent = 2.0;    ///< n [-]; 2 ellipse, 4 nearly a rectangle
};

/// Sweep through sections of increasing x, monotone cubic (no overshoot) between them, cut flat at the first
/// and the last. For a round end let the last sections shrink like an ellipse; see add_round_end. First-order
/// distance.
/// @pre at least 2 sections; every half size > 0.
Solid sweep(std::vector<Section> sections);

/// Sections between `section` and a tip `length` [m] further along x (negative: towards smaller x), that
/// shrink like an ellipse to 2 % of the size; in order of increasing x, without `section` itself.
std::vector<Section> round_end(const Section& section, double length, int count = 8);

/// Point of a planar outline [m]: (x, y) for extrude, (radius, z) for revolve.
using Point2 = std::array<double, 2>;
using Polyline = std::vector<Point2>;

/// Body of revolution around z of the closed outline (radius, z), radius >= 0. Where the first and the last
/// point lie on the axis the edge between them is no surface. Exact.
Solid revolve(const Polyline& outline);

/// Prism over the closed outline (x, y) from z_low to z_high, top and bottom rim rounded with edge_radius;
/// the corners of the outline stay as they are (see round_corners).
Solid extrude(const Polyline& outline, double z_low, double z_high, double edge_radius = 0.0);

/// The outline with corner i rounded by an arc of radii[i] (0 keeps the corner), as short chords of at most
/// max_angle [rad]. A radius that does not fit is made smaller. The outline is closed; where `open`, the
/// first and the last point are ends and stay.
Polyline round_corners(const Polyline& outline, const std::vector<double>& radii, bool open = false,
                       double max_angle = 0.15);

/// Centripetal Catmull-Rom spline through the points, `steps` chords a span. Open: from the first to the
/// last.
Polyline smooth_curve(const Polyline& points, int steps = 12, bool closed = false);

/// Signed distance [m] in the plane to a closed outline, negative inside; edge i goes from point i to i + 1.
/// Where skip_last, the closing edge counts for inside and outside but not for the distance.
double outline_distance(const Polyline& outline, double x, double y, bool skip_last = false);

}  // namespace eigengrasp::modeling
