// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shape/cone_operator.hpp"
#include "shape/moment_sum.hpp"
#include "shape/triangle_rule.hpp"

namespace eigengrasp {

namespace {

using Corners = std::array<Vec3, 3>;  // in the unit ball

/// How far apart the corners are as Zernike functions see it: lengths, and, as they oscillate faster near the
/// ball's surface, angles whose cosine is the distance from the centre.
double spread(const Corners& p) {
  double longest = 0.0, low = 4.0, high = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, (p[k] - p[(k + 1) % 3]).norm());
    const double angle = std::acos(std::min(1.0, p[k].norm()));
    low = std::min(low, angle);
    high = std::max(high, angle);
  }
  return longest + high - low;
}

/// Nodes a side: enough for an error of about 1e-7 a unit of area, measured on random triangles of order 20;
/// at most those that are exact.
int rule_side(const Corners& p, int order) {
  constexpr std::array<double, 10> bounds{0.005, 0.012, 0.037, 0.10, 0.18, 0.28, 0.40, 0.55, 0.70, 0.92};
  const int exact = order / 2 + 1;
  const double reach = spread(p) * order / 20.0;
  const auto place = std::lower_bound(bounds.begin(), bounds.end(), reach);
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

void add_triangle(MomentSum& sum, const Corners& p, double weight, int order) {
  const Vec3 u = p[1] - p[0], v = p[2] - p[0];
  for (const TriangleRule::Node& node : triangle_rule(rule_side(p, order)).nodes)
    sum.add(p[0] + node.u * u + node.v * v, weight * node.weight);
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
