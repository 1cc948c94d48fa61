// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eigengrasp {

namespace {

/// Height of the surface below the tangent plane under the probe, to first order in the tilt of the surface
/// there. @param last the triangle nearest to the last probe, or -1: bounds the search
double depth_below(const MeshBvh& bvh, const Vec3& probe, const Vec3& n, double radius, int& last) {
  ClosestPoint q{Vec3::Zero(), 2.0 * radius, -1};
  if (last >= 0) {
    const Vec3 near = closest_point_on_triangle(bvh.corners(last), probe);
    const double distance = (near - probe).norm();
    if (distance < q.distance) q = {near, distance, last};
  }
  const ClosestPoint nearer = bvh.closest_point(probe, q.distance);
  if (nearer.triangle >= 0) q = nearer;
  if (q.triangle < 0) return radius;
  last = q.triangle;
  // The closest point is not straight below the probe: follow the surface's plane there to the vertical.
  const TriangleCorners& t = bvh.corners(q.triangle);
  const Vec3 m = (t.b - t.a).cross(t.c - t.a);
  const bool beyond_edge =
      q.distance > 0.02 * radius && std::abs(m.dot(probe - q.point)) < 0.7 * m.norm() * q.distance;
  if (beyond_edge) return radius;
  const double tilt = m.norm() > 0.0 ? m.dot(n) / m.norm() : 0.0;
  const double straight = tilt > 0.2 ? m.dot(probe - q.point) / (m.norm() * tilt) : n.dot(probe - q.point);
  return std::clamp(straight, -radius, radius);
}

}  // namespace

Eigen::Matrix2d estimate_curvature(const MeshBvh& bvh, const Vec3& p, const Vec3& n, const Vec3& t1,
                                   const Vec3& t2, double radius) {
  constexpr int directions = 8;
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int last = -1;
  for (const double r : {0.5 * radius, radius})
    for (int i = 0; i < directions; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / directions;
      const double u = r * std::cos(angle);
      const double v = r * std::sin(angle);
      const double depth = depth_below(bvh, p + u * t1 + v * t2, n, radius, last);
      const Eigen::Vector3d row(0.5 * u * u, u * v, 0.5 * v * v);  // depth = row . (k11, k12, k22)
      normal_matrix += row * row.transpose();
      right += depth * row;
    }
  const Eigen::Vector3d k = normal_matrix.ldlt().solve(right);
  Eigen::Matrix2d K;
  K << k[0], k[1], k[1], k[2];
  return K;
}

}  // namespace eigengrasp
