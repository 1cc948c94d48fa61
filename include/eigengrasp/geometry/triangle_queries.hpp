// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// Corners of a triangle [m].
struct TriangleCorners {
  Vec3 a, b, c;
};

/// Point of a (possibly degenerate) triangle that is nearest to p.
Vec3 closest_point_on_triangle(const TriangleCorners& t, const Vec3& p);

/// Nearest points of two segments p0-p1 and q0-q1 (either may be a point). Returns their distance [m].
double closest_points_of_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1, Vec3& on_p,
                                  Vec3& on_q);

/// Whether the segment p0-p1 meets the triangle; then `hit` is where. False for segments in the triangle's
/// plane.
bool segment_hits_triangle(const Vec3& p0, const Vec3& p1, const TriangleCorners& t, Vec3& hit);

/// Whether two triangles cross, i.e. an edge of one meets the other.
bool triangles_cross(const TriangleCorners& s, const TriangleCorners& t);

/// Whether the plane of one of the triangles keeps the other at more than `distance` [m]: then so far apart
/// are they at least. A cheap test before the exact one; false says nothing.
bool plane_separates(const TriangleCorners& s, const TriangleCorners& t, double distance);

/// Distance [m] of two triangles, 0 where they cross, and a nearest pair of points.
double closest_points_of_triangles(const TriangleCorners& s, const TriangleCorners& t, Vec3& on_s,
                                   Vec3& on_t);

}  // namespace eigengrasp
