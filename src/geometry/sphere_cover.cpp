// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/sphere_cover.hpp"

#include <algorithm>
#include <cmath>

namespace eigengrasp {

SurfaceSamples sample_surface(const TriangleMesh& mesh, double spacing) {
  SurfaceSamples samples;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = area_normal(mesh, t);
    if (!(normal.norm() > 0.0)) continue;
    const Vec3& a = mesh.corner(t, 0);
    const Vec3 ab = mesh.corner(t, 1) - a;
    const Vec3 ac = mesh.corner(t, 2) - a;
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
    for (int i = 0; i < n; ++i)  // centres of the n^2 equal sub-triangles that point up or down
      for (int j = 0; j < n - i; ++j)
        for (double third : {1.0 / 3.0, 2.0 / 3.0}) {
          if (third > 0.5 && j == n - i - 1) continue;
          samples.points.push_back(a + (i + third) / n * ab + (j + third) / n * ac);
          samples.normals.push_back(normal.normalized());
        }
  }
  return samples;
}

namespace {

void split(std::vector<Sphere>& spheres, int first, int count, int group_size,
           std::vector<SphereGroup>& groups) {
  if (count <= group_size) {
    if (count > 0)
      groups.push_back({bounding_sphere(std::span<const Sphere>(spheres).subspan(
                            static_cast<std::size_t>(first), static_cast<std::size_t>(count))),
                        first, count});
    return;
  }
  Box centers;
  for (int i = first; i < first + count; ++i) centers.add(spheres[static_cast<std::size_t>(i)].center);
  Eigen::Index axis = 0;
  centers.size().maxCoeff(&axis);
  const auto begin = spheres.begin() + first;
  std::stable_sort(begin, begin + count,
                   [axis](const Sphere& a, const Sphere& b) { return a.center[axis] < b.center[axis]; });
  const int half = count / 2;
  split(spheres, first, half, group_size, groups);
  split(spheres, first + half, count - half, group_size, groups);
}

}  // namespace

std::vector<SphereGroup> group_spheres(std::vector<Sphere>& spheres, int group_size) {
  std::vector<SphereGroup> groups;
  split(spheres, 0, static_cast<int>(spheres.size()), group_size, groups);
  return groups;
}

Sphere bounding_sphere(std::span<const Sphere> spheres) {
  Box box;
  for (const Sphere& s : spheres) {
    box.add(s.center - Vec3::Constant(s.radius));
    box.add(s.center + Vec3::Constant(s.radius));
  }
  Sphere bound{box.center(), 0.0};
  for (const Sphere& s : spheres)
    bound.radius = std::max(bound.radius, (s.center - bound.center).norm() + s.radius);
  return bound;
}

Sphere bounding_sphere(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  const auto farthest_from = [&](const Vec3& p) {
    return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return (a - p).squaredNorm() < (b - p).squaredNorm();
    });
  };
  const Vec3 a = farthest_from(points.front());
  const Vec3 b = farthest_from(a);
  Sphere ball{0.5 * (a + b), 0.5 * (a - b).norm()};
  for (const Vec3& p : points) {
    const double d = (p - ball.center).norm();
    if (d <= ball.radius) continue;
    const double r = 0.5 * (ball.radius + d);
    ball.center += (d - r) / d * (p - ball.center);
    ball.radius = r;
  }
  for (const Vec3& p : points) ball.radius = std::max(ball.radius, (p - ball.center).norm());
  return ball;
}

}  // namespace eigengrasp
