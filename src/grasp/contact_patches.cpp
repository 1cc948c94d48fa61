// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "grasp/contact_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace eigengrasp {

namespace {

/// Thins the points out: of those nearer than `spacing` with nearly the same normal the nearest to the solid
/// stays.
std::vector<TouchPoint> thin_out(std::vector<TouchPoint> points, double spacing) {
  std::stable_sort(points.begin(), points.end(),
                   [](const TouchPoint& a, const TouchPoint& b) { return a.distance < b.distance; });
  std::vector<TouchPoint> kept;
  for (const TouchPoint& p : points) {
    const bool repeated = std::any_of(kept.begin(), kept.end(), [&](const TouchPoint& k) {
      return (k.p - p.p).squaredNorm() < spacing * spacing && k.n.dot(p.n) > 0.9;
    });
    if (!repeated) kept.push_back(p);
  }
  return kept;
}

/// Connected regions by single linkage (union-find).
std::vector<std::vector<TouchPoint>> split_regions(const std::vector<TouchPoint>& points,
                                                   double link_distance) {
  std::vector<std::size_t> parent(points.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const double min_cosine = std::cos(25.0 * M_PI / 180.0);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (((points[i].p - points[j].p).squaredNorm() < link_distance * link_distance ||
           (points[i].triangle >= 0 && points[i].triangle == points[j].triangle)) &&
          points[i].n.dot(points[j].n) > min_cosine)
        parent[std::max(root(i), root(j))] = std::min(root(i), root(j));
  std::vector<std::vector<TouchPoint>> regions;
  std::vector<int> region_of(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    int& region = region_of[root(i)];
    if (region < 0) {
      region = static_cast<int>(regions.size());
      regions.emplace_back();
    }
    regions[static_cast<std::size_t>(region)].push_back(points[i]);
  }
  return regions;
}

struct Planar {
  double u, v;
  std::size_t index;
};

double turn(const Planar& a, const Planar& b, const Planar& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Convex hull in the plane (Andrew's monotone chain), counter-clockwise.
std::vector<Planar> convex_hull(std::vector<Planar> p) {
  std::sort(p.begin(), p.end(),
            [](const Planar& a, const Planar& b) { return a.u != b.u ? a.u < b.u : a.v < b.v; });
  if (p.size() < 3) return p;
  std::vector<Planar> hull;
  const auto add = [&](const Planar& q, std::size_t floor) {
    while (hull.size() >= floor + 2 && turn(hull[hull.size() - 2], hull.back(), q) <= 0.0) hull.pop_back();
    hull.push_back(q);
  };
  for (const Planar& q : p) add(q, 0);
  hull.pop_back();
  const std::size_t lower = hull.size();
  for (std::size_t i = p.size(); i-- > 0;) add(p[i], lower);
  hull.pop_back();
  return hull;
}

/// Rounding leaves points of straight sides in the hull.
void drop_points_of_sides(std::vector<TouchPoint>& corners) {
  constexpr double straight = 1e-5;  // [m]
  for (std::size_t i = 0; i < corners.size() && corners.size() > 2;) {
    const Vec3& p = corners[i].p;
    const Vec3& a = corners[(i + corners.size() - 1) % corners.size()].p;
    const Vec3& b = corners[(i + 1) % corners.size()].p;
    if ((closest_point_on_triangle({a, b, b}, p) - p).norm() < straight) {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

std::vector<TouchPoint> perimeter(const std::vector<TouchPoint>& region, double merge) {
  Vec3 n = Vec3::Zero();
  Vec3 center = Vec3::Zero();
  for (const TouchPoint& t : region) {
    n += t.n;
    center += t.p / static_cast<double>(region.size());
  }
  n.normalize();
  const auto [t1, t2] = contact_tangents(n);
  std::vector<Planar> planar;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Vec3 d = region[i].p - center;
    planar.push_back({d.dot(t1), d.dot(t2), i});
  }
  std::vector<TouchPoint> hull;
  for (const Planar& h : convex_hull(planar)) hull.push_back(region[h.index]);
  drop_points_of_sides(hull);
  std::vector<TouchPoint> corners;
  for (TouchPoint t : hull) {
    t.n = n;
    const bool close = std::any_of(corners.begin(), corners.end(), [&](const TouchPoint& c) {
      return (c.p - t.p).squaredNorm() < merge * merge;
    });
    if (!close) corners.push_back(t);
  }
  if (corners.size() != 1) return corners;
  // A region smaller than the merge distance: the point of it nearest to its middle.
  const auto middle =
      std::min_element(region.begin(), region.end(), [&](const TouchPoint& a, const TouchPoint& b) {
        return (a.p - center).squaredNorm() < (b.p - center).squaredNorm();
      });
  corners[0].p = middle->p;
  corners[0].distance = middle->distance;
  return corners;
}

}  // namespace

std::vector<std::vector<TouchPoint>> make_patches(std::vector<TouchPoint> points, double merge) {
  if (points.size() > 64) points = thin_out(std::move(points), 0.25 * merge);
  std::vector<std::vector<TouchPoint>> patches;
  for (const auto& region : split_regions(points, 2.0 * merge)) patches.push_back(perimeter(region, merge));
  return patches;
}

}  // namespace eigengrasp
