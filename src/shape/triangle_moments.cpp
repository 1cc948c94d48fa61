// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "shape/cone_operator.hpp"
#include "shape/moment_sum.hpp"
#include "shape/triangle_rule.hpp"

namespace eigengrasp {

namespace {

using Corners = std::array<Vec3, 3>;  // in the unit ball

/// How far apart points are as Zernike functions see it: their distance, and, as the functions oscillate
/// faster near the ball's surface, the range of angles whose cosine is the distance from the centre.
double spread(double distance, std::initializer_list<double> radii) {
  const auto [low, high] = std::minmax(radii);
  return distance + std::acos(std::min(1.0, low)) - std::acos(std::min(1.0, high));
}

/// Nodes for a spread: enough for an error of about 5e-7 a unit of area, measured on random triangles of
/// order 20; at most those that are exact.
int node_count(double spread, int order) {
  constexpr std::array<double, 10> bounds{0.007, 0.016, 0.048, 0.115, 0.20, 0.305, 0.43, 0.59, 0.75, 0.97};
  const int exact = order / 2 + 1;
  const auto place = std::lower_bound(bounds.begin(), bounds.end(), spread * order / 20.0);
  if (place == bounds.end()) return exact;
  return std::min(exact, 1 + static_cast<int>(place - bounds.begin()));
}

/// Calls visit(corners, area vector) in the unit ball for every triangle that has an area.
template <class Visit>
void for_each_triangle(const TriangleMesh& mesh, const ShapeBall& ball, const Visit& visit) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Corners p;
    for (int k = 0; k < 3; ++k)
      p[static_cast<std::size_t>(k)] = (mesh.corner(t, k) - ball.center) / ball.radius;
    const Vec3 area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
    if (area.squaredNorm() > 0.0) visit(p, area);
  }
}

/// The corners in another order: the shortest side is that from the last to the first.
Corners shortest_side_last(const Corners& p) {
  const double ab = (p[0] - p[1]).squaredNorm(), bc = (p[1] - p[2]).squaredNorm();
  const double ca = (p[2] - p[0]).squaredNorm();
  if (ab < bc && ab < ca) return {p[1], p[2], p[0]};
  if (bc < ca) return {p[2], p[0], p[1]};
  return p;
}

void add_triangle(MomentSum& sum, const Corners& corners, double weight, int order) {
  const auto [a, b, c] = shortest_side_last(corners);
  const double ra = a.norm(), rb = b.norm(), rc = c.norm();
  const Vec3 ab = b - a, ac = c - a;
  const int along = node_count(spread(std::max(ab.norm(), (b - c).norm()), {ra, rb, rc}), order);
  const int across = node_count(spread(ac.norm(), {ra, rc}), order);
  for (const TriangleRule::Node& node : triangle_rule(along, across).nodes)
    sum.add(a + node.u * ab + node.v * ac, weight * node.weight);
}

}  // namespace

ZernikeMoments compute_solid_moments(const TriangleMesh& mesh, const ShapeBall& ball, int order) {
  MomentSum sum(order);
  constexpr double norm = 3.0 / (4.0 * std::numbers::pi);
  for_each_triangle(mesh, ball, [&](const Corners& p, const Vec3& area) {
    add_triangle(sum, p, norm * area.dot(p[0]), order);
  });
  return apply_cone_operator(sum.moments());
}

ZernikeMoments compute_surface_moments(const TriangleMesh& mesh, const ShapeBall& ball, int order) {
  MomentSum sum(order);
  double total = 0.0;
  for_each_triangle(mesh, ball, [&](const Corners&, const Vec3& area) { total += area.norm(); });
  for_each_triangle(mesh, ball, [&](const Corners& p, const Vec3& area) {
    add_triangle(sum, p, area.norm() / total, order);
  });
  return sum.moments();
}

}  // namespace eigengrasp
