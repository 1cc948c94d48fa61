// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/grid_moments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "shape/distance_grid.hpp"
#include "shape/moment_sum.hpp"

namespace eigengrasp {

namespace {

constexpr int grid_side = 40;
constexpr double window_start = 0.8;  // of the radius

double window(double r) {
  if (r <= window_start) return 1.0;
  if (r >= 1.0) return 0.0;
  return 0.5 * (1.0 + std::cos(std::numbers::pi * (r - window_start) / (1.0 - window_start)));
}

/// Sums value(center, distance) over the cells whose centres lie in the unit ball.
template <class Value>
ZernikeMoments grid_moments(const DistanceGrid& grid, int order, const Value& value) {
  MomentSum sum(order);
  const double norm = 3.0 / (4.0 * std::numbers::pi) * std::pow(grid.cell(), 3);
  for (int z = 0; z < grid.side(); ++z)
    for (int y = 0; y < grid.side(); ++y)
      for (int x = 0; x < grid.side(); ++x) {
        const Vec3 p = grid.center(x, y, z);
        if (p.squaredNorm() > 1.0) continue;
        if (const double f = value(p, grid.distance(x, y, z)); f > 0.0) sum.add(p, norm * f);
      }
  return sum.moments();
}

}  // namespace

ZernikeMoments compute_thick_surface_moments(const TriangleMesh& mesh, const ShapeBall& ball, double width,
                                             int order) {
  constexpr double reach = 4.8;  // widths: there the function is 1e-5
  DistanceGrid grid(grid_side, reach * width);
  grid.add_surface(mesh, ball);
  return grid_moments(grid, order, [&](const Vec3& p, double distance) {
    if (distance > reach * width) return 0.0;
    return window(p.norm()) * std::exp(-0.5 * distance * distance / (width * width));
  });
}

ZernikeMoments compute_filled_moments(const TriangleMesh& mesh, const ShapeBall& ball, int order) {
  const MeshBvh bvh(mesh);
  DistanceGrid grid(grid_side, 2.0);
  grid.add_surface(mesh, ball);
  bool any_inside = false;
  ZernikeMoments moments = grid_moments(grid, order, [&](const Vec3& p, double distance) {
    const bool inside = bvh.winding_number(ball.center + ball.radius * p) > 0.5;
    any_inside = any_inside || inside;
    return std::clamp(0.5 + (inside ? distance : -distance) / grid.cell(), 0.0, 1.0);
  });
  return any_inside ? moments : ZernikeMoments(order);
}

}  // namespace eigengrasp
