// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/curvature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/nearest_triangles.hpp"

namespace eigengrasp {

namespace {

/// Height of the surface below the tangent plane under the probe, to first order in the tilt of the surface
/// there. @param nearest the triangle nearest to the probe; -1: none is within two radii
double depth_below(const MeshBvh& bvh, int nearest, const Vec3& probe, const Vec3& n, double radius) {
  if (nearest < 0) return radius;
  const TriangleCorners& t = bvh.corners(nearest);
  const Vec3 point = closest_point_on_triangle(t, probe);
  const double distance = (point - probe).norm();
  // The closest point is not straight below the probe: follow the surface's plane there to the vertical.
  const Vec3 m = (t.b - t.a).cross(t.c - t.a);
  const bool beyond_edge =
      distance > 0.02 * radius && std::abs(m.dot(probe - point)) < 0.7 * m.norm() * distance;
  if (beyond_edge) return radius;
  const double tilt = m.norm() > 0.0 ? m.dot(n) / m.norm() : 0.0;
  const double straight = tilt > 0.2 ? m.dot(probe - point) / (m.norm() * tilt) : n.dot(probe - point);
  return std::clamp(straight, -radius, radius);
}

}  // namespace

Eigen::Matrix2d estimate_curvature(const MeshBvh& bvh, const Vec3& p, const Vec3& n, const Vec3& t1,
                                   const Vec3& t2, double radius) {
  constexpr std::size_t directions = 8;
  struct Probe {
    double u, v;
  };
  std::array<Probe, detail::most_points> probes;
  std::array<Vec3, detail::most_points> points;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const double r = i < directions ? 0.5 * radius : radius;
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i % directions) / directions;
    probes[i] = {r * std::cos(angle), r * std::sin(angle)};
    points[i] = p + probes[i].u * t1 + probes[i].v * t2;
  }
  const auto nearest = detail::find_nearest_triangles(bvh, p, points, 2.0 * radius);
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto [u, v] = probes[i];
    const double depth = depth_below(bvh, nearest[i], points[i], n, radius);
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
