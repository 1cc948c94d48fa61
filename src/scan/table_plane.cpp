// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/scan/table_plane.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "eigengrasp/core/random.hpp"

namespace eigengrasp {

namespace {

constexpr double kLeastShare = 0.2;

std::size_t count_near(const std::vector<Vec3>& points, const TablePlane& plane, double tolerance) {
  return static_cast<std::size_t>(std::count_if(
      points.begin(), points.end(), [&](const Vec3& p) { return std::abs(plane.above(p)) <= tolerance; }));
}

/// Least squares plane through what lies near.
TablePlane fitted(const std::vector<Vec3>& points, const TablePlane& about, double tolerance) {
  Vec3 mean = Vec3::Zero();
  double count = 0.0;
  for (const Vec3& p : points) {
    if (std::abs(about.above(p)) > tolerance) continue;
    mean += p;
    count += 1.0;
  }
  mean /= count;
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : points)
    if (std::abs(about.above(p)) <= tolerance) covariance += (p - mean) * (p - mean).transpose();
  Vec3 normal = Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors().col(0);
  if (normal.dot(about.normal) < 0.0) normal = -normal;
  return {normal, normal.dot(mean)};
}

using Cell = std::array<int, 3>;

Cell cell_of(const Vec3& p, double side) {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<int>(std::floor(p[static_cast<int>(k)] / side));
  return cell;
}

}  // namespace

std::optional<TablePlane> find_table(const std::vector<Vec3>& points, const Vec3& viewpoint,
                                     double tolerance) {
  if (points.size() < 10) return std::nullopt;
  RandomStream random({0x7461626c65ULL, points.size()});
  TablePlane best;
  std::size_t most = 0;
  for (int i = 0; i < 400; ++i) {
    const auto pick = [&] { return points[static_cast<std::size_t>(random() % points.size())]; };
    const Vec3 a = pick(), b = pick(), c = pick();
    Vec3 normal = (b - a).cross(c - a);
    if (normal.norm() < 1e-12) continue;
    normal.normalize();
    TablePlane plane{normal, normal.dot(a)};
    if (plane.above(viewpoint) < 0.0) plane = {-plane.normal, -plane.height};
    const std::size_t near = count_near(points, plane, tolerance);
    if (near <= most) continue;
    most = near;
    best = plane;
  }
  if (static_cast<double>(most) < kLeastShare * static_cast<double>(points.size())) return std::nullopt;
  best = fitted(points, best, tolerance);
  std::size_t above = 0, below = 0;
  for (const Vec3& p : points) {
    above += best.above(p) > tolerance;
    below += best.above(p) < -tolerance;
  }
  // What has as much on the far side is a face of the object, or a wall.
  if (above == 0 || 4 * below > above) return std::nullopt;
  return best;
}

std::vector<Vec3> object_above(const TablePlane& table, const std::vector<Vec3>& points, double clearance,
                               double reach) {
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (table.above(points[i]) > clearance) cells[cell_of(points[i], reach)].push_back(i);
  std::vector<std::size_t> largest;
  while (!cells.empty()) {
    std::vector<std::size_t> group;
    std::vector<Cell> open = {cells.begin()->first};
    while (!open.empty()) {
      const auto it = cells.find(open.back());
      open.pop_back();
      if (it == cells.end()) continue;
      const Cell c = it->first;
      group.insert(group.end(), it->second.begin(), it->second.end());
      cells.erase(it);
      for (int k = 0; k < 27; ++k)
        if (const Cell n = {c[0] + k % 3 - 1, c[1] + k / 3 % 3 - 1, c[2] + k / 9 - 1}; cells.contains(n))
          open.push_back(n);
    }
    if (group.size() > largest.size()) largest = std::move(group);
  }
  std::sort(largest.begin(), largest.end());
  std::vector<Vec3> result;
  for (const std::size_t i : largest) result.push_back(points[i]);
  return result;
}

}  // namespace eigengrasp
