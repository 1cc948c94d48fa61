// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/scan/mirror_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scan/sphere_directions.hpp"

namespace eigengrasp {

namespace {

constexpr int kNormals = 500;          // of the whole sphere
constexpr double kLeastFacing = 0.26;  // cosine of 75 degrees
constexpr int kOffsets = 24;
constexpr double kConflicts = 0.10;  // more is refused

using Outside = std::function<double(const Vec3&)>;

std::vector<Vec3> some_of(const std::vector<Vec3>& points, std::size_t count) {
  std::vector<Vec3> some;
  const std::size_t step = std::max<std::size_t>(points.size() / count, 1);
  for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
  return some;
}

/// Level ones all around, and down: of upright planes and of a level one.
std::vector<Vec3> standing_normals(const Vec3& up) {
  std::vector<Vec3> normals = {-up.normalized()};
  const Vec3 x = up.unitOrthogonal(), y = up.normalized().cross(x);
  constexpr int count = 120;
  for (int i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / count;
    normals.push_back(std::cos(turn) * x + std::sin(turn) * y);
  }
  return normals;
}

void judge(MirrorPlane& plane, const std::vector<Vec3>& points, const Outside& outside, double tolerance) {
  int conflicts = 0, support = 0;
  for (const Vec3& p : points) {
    const double d = outside(plane.mirrored(p));
    conflicts += d > tolerance;
    support += std::abs(d) <= tolerance;
  }
  plane.conflicts = conflicts / static_cast<double>(points.size());
  plane.support = support / static_cast<double>(points.size());
}

/// Root of the mean squared distance from the centre.
double size_of(const std::vector<Vec3>& points) {
  Vec3 mean = Vec3::Zero();
  double sum = 0.0;
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  for (const Vec3& p : points) sum += (p - mean).squaredNorm() / static_cast<double>(points.size());
  return std::sqrt(sum);
}

}  // namespace

std::optional<MirrorPlane> find_mirror_plane(const std::vector<Vec3>& points, const Outside& outside,
                                             const Vec3& direction, double tolerance,
                                             const std::optional<Vec3>& up) {
  const std::vector<Vec3> some = some_of(points, 400);
  const double size = size_of(some);
  std::optional<MirrorPlane> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& normal : up ? standing_normals(*up) : sphere_directions(kNormals)) {
    if (normal.dot(direction) < kLeastFacing) continue;
    double front = std::numeric_limits<double>::infinity(), back = -front;
    for (const Vec3& p : some) {
      front = std::min(front, normal.dot(p));
      back = std::max(back, normal.dot(p));
    }
    // From the middle of what is seen to somewhat behind it.
    const double first = 0.5 * (front + back), last = back + 0.5 * size;
    for (int k = 0; k < kOffsets; ++k) {
      MirrorPlane plane{normal, first + (last - first) * k / (kOffsets - 1), 0.0, 0.0};
      judge(plane, some, outside, tolerance);
      if (plane.conflicts > kConflicts) continue;
      const double thickness = 2.0 * (plane.offset - front) / size;
      const double cost = 4.0 * plane.conflicts + 0.25 * thickness - 0.5 * plane.support;
      if (cost >= least) continue;
      least = cost;
      best = plane;
    }
  }
  return best;
}

}  // namespace eigengrasp
