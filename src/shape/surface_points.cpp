// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/surface_points.hpp"

#include <cmath>

namespace eigengrasp {

namespace {

/// Part i of a sequence that fills the unit square evenly (Roberts's R2: steps of the plastic number).
std::pair<double, double> even_place(int i) {
  constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
  const double u = 0.5 + step_u * i, v = 0.5 + step_v * i;
  return {u - std::floor(u), v - std::floor(v)};
}

Vec3 point_in(const TriangleMesh& mesh, std::size_t t, std::pair<double, double> place) {
  auto [u, v] = place;
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const Vec3& a = mesh.corner(t, 0);
  return a + u * (mesh.corner(t, 1) - a) + v * (mesh.corner(t, 2) - a);
}

}  // namespace

SurfacePoints spread_points(const TriangleMesh& mesh, int count) {
  SurfacePoints spread;
  const double step = surface_area(mesh) / count;
  double passed = 0.0;  // area of the triangles so far
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 n = area_normal(mesh, t);
    passed += 0.5 * n.norm();
    while (static_cast<int>(spread.points.size()) < count &&
           (static_cast<double>(spread.points.size()) + 0.5) * step < passed) {
      spread.points.push_back(point_in(mesh, t, even_place(static_cast<int>(spread.points.size()))));
      spread.normals.push_back(n.normalized());
    }
  }
  return spread;
}

SurfaceSpread surface_spread(const TriangleMesh& mesh) {
  SurfaceSpread s;
  const Vec3 origin = bounding_box(mesh).center();
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = 0.5 * area_normal(mesh, t).norm();
    const Vec3 a = mesh.corner(t, 0) - origin, b = mesh.corner(t, 1) - origin, c = mesh.corner(t, 2) - origin;
    const Vec3 sum = a + b + c;
    s.area += area;
    first += area / 3.0 * sum;
    second +=
        area / 12.0 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  if (s.area == 0.0) return s;
  const Vec3 mean = first / s.area;
  s.center = origin + mean;
  s.covariance = second / s.area - mean * mean.transpose();
  return s;
}

}  // namespace eigengrasp
