// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/scan/viewpoint.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "scan/sphere_directions.hpp"

namespace eigengrasp {

namespace {

/// Pixels of width pitch [m] that hold a point, looking along `into`.
std::size_t filled_pixels(const std::vector<Vec3>& points, const Vec3& into, double pitch) {
  const Vec3 right = into.unitOrthogonal(), down = into.cross(right);
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Vec3& p : points) {
    const auto x = static_cast<std::int32_t>(std::floor(right.dot(p) / pitch));
    const auto y = static_cast<std::int32_t>(std::floor(down.dot(p) / pitch));
    keys.push_back((std::uint64_t{static_cast<std::uint32_t>(x)} << 32) | static_cast<std::uint32_t>(y));
  }
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
}

/// Positive where the middle of the picture lies nearer than its rim. @pre centred points
double bulge(const std::vector<Vec3>& points, const Vec3& into) {
  double mean = 0.0, sum = 0.0;
  const auto off_axis = [&](const Vec3& p) { return (p - into.dot(p) * into).squaredNorm(); };
  for (const Vec3& p : points) mean += off_axis(p) / static_cast<double>(points.size());
  for (const Vec3& p : points) sum += (off_axis(p) - mean) * into.dot(p);
  return sum;
}

}  // namespace

Vec3 estimate_viewpoint(const std::vector<Vec3>& points, double spacing) {
  constexpr int kDirections = 600;
  constexpr std::size_t kPoints = 4000;
  std::vector<Vec3> some;
  Vec3 middle = Vec3::Zero();
  Box box;
  const std::size_t step = (points.size() + kPoints - 1) / kPoints;
  for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
  for (const Vec3& p : some) {
    middle += p / static_cast<double>(some.size());
    box.add(p);
  }
  for (Vec3& p : some) p -= middle;
  const double pitch = 1.5 * spacing * std::sqrt(static_cast<double>(step));
  Vec3 into = Vec3::UnitZ();
  std::size_t most = 0;
  for (const Vec3& direction : sphere_directions(kDirections)) {
    if (direction.z() < 0.0) continue;  // the other half fills as many
    const std::size_t filled = filled_pixels(some, direction, pitch);
    if (filled <= most) continue;
    most = filled;
    into = direction;
  }
  if (bulge(some, into) < 0.0) into = -into;
  return middle - 6.0 * box.diagonal() * into;
}

}  // namespace eigengrasp
