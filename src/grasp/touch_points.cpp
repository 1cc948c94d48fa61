// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cmath>

#include "eigengrasp/grasp/contact_finder.hpp"

namespace eigengrasp {

namespace {

TriangleCorners posed(const Pose& X, const TriangleCorners& t) {
  return {X * t.a, X * t.b, X * t.c};
}

Vec3 unit_normal(const TriangleCorners& t) {
  const Vec3 n = (t.b - t.a).cross(t.c - t.a);
  const double length = n.norm();
  return length > 0.0 ? Vec3(n / length) : Vec3::Zero();
}

/// Whether p, a point of the triangle, lies on its face and not on an edge or a corner.
bool on_face(const TriangleCorners& t, const Vec3& p) {
  constexpr double border = 1e-6;
  const Vec3 n = (t.b - t.a).cross(t.c - t.a);
  const double area2 = n.squaredNorm();
  if (!(area2 > 0.0)) return false;
  const double u = n.dot((t.c - t.b).cross(p - t.b)) / area2;
  const double v = n.dot((t.a - t.c).cross(p - t.c)) / area2;
  return u > border && v > border && 1.0 - u - v > border;
}

/// Direction in which the link presses on the solid. A face knows it best; two edges have the line between
/// them, or, where they as good as touch, the mean of their faces' normals.
Vec3 contact_normal(const ClosestPair& pair, const TriangleCorners& solid, const TriangleCorners& link) {
  const Vec3 line = pair.p_a - pair.p_b;
  const Vec3 into_solid = -unit_normal(solid);
  const Vec3 out_of_link = unit_normal(link);
  Vec3 n;
  if (on_face(solid, pair.p_a)) {
    n = into_solid;
  } else if (on_face(link, pair.p_b)) {
    n = out_of_link;
  } else if (pair.distance > 2e-5) {
    return line / pair.distance;
  } else {
    n = (into_solid + out_of_link).normalized();
  }
  // Soups may have faces that look the wrong way.
  const bool wrong = pair.distance > 1e-6 ? n.dot(line) < 0.0 : n.dot(out_of_link) < -0.5;
  return wrong ? Vec3(-n) : n;
}

constexpr double clearly_nearer = 0.9;

/// Whether no other point of either surface is clearly nearer: an edge beside the face that really touches is
/// not where two surfaces touch.
bool nearest_to_each_other(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL,
                           const ClosestPair& pair) {
  const double nearer = clearly_nearer * pair.distance;
  return link.closest_point(X_SL.inverse() * pair.p_a, nearer).triangle < 0 &&
         solid.closest_point(pair.p_b, nearer).triangle < 0;
}

/// The same, told by the pairs of all triangles that are at most as far apart.
bool nearest_to_each_other(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL,
                           const ClosestPair& pair, const std::vector<ClosestPair>& all) {
  const double nearer = clearly_nearer * pair.distance;
  const auto is_near = [nearer](const TriangleCorners& t, const Vec3& p) {
    return (closest_point_on_triangle(t, p) - p).squaredNorm() < nearer * nearer;
  };
  return std::ranges::none_of(all, [&](const ClosestPair& other) {
    if (other.distance >= nearer) return false;
    return (other.triangle_a == pair.triangle_a &&
            is_near(posed(X_SL, link.corners(other.triangle_b)), pair.p_a)) ||
           (other.triangle_b == pair.triangle_b && is_near(solid.corners(other.triangle_a), pair.p_b));
  });
}

/// All corners of the region in which two nearly parallel faces are within the threshold: corners of one over
/// the face of the other, and crossings of their edges.
void add_overlap(const TriangleCorners& s, const TriangleCorners& t, double threshold, const Vec3& n,
                 int triangle, std::vector<TouchPoint>& points) {
  const auto add = [&](const Vec3& on_s, const Vec3& on_t) {
    const double d = (on_s - on_t).norm();
    if (d <= threshold) points.push_back({on_s, n, d, triangle});
  };
  const Vec3 cs[] = {s.a, s.b, s.c};
  const Vec3 ct[] = {t.a, t.b, t.c};
  for (const Vec3& p : ct) add(closest_point_on_triangle(s, p), p);
  for (const Vec3& p : cs) add(p, closest_point_on_triangle(t, p));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Vec3 p, q;
      closest_points_of_segments(cs[i], cs[(i + 1) % 3], ct[j], ct[(j + 1) % 3], p, q);
      add(p, q);
    }
}

/// What two triangles add to the touching points. @param nearest whether nearest_to_each_other
template <typename Nearest>
void add_touches(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL, const ClosestPair& pair,
                 double threshold, Nearest nearest, std::vector<TouchPoint>& points) {
  constexpr double parallel = -0.999;  // cosine of the normals
  const TriangleCorners& s = solid.corners(pair.triangle_a);
  const TriangleCorners t = posed(X_SL, link.corners(pair.triangle_b));
  const Vec3 n = contact_normal(pair, s, t);
  if (n.squaredNorm() < 0.5) return;
  const Vec3 ns = unit_normal(s);
  if (ns.dot(unit_normal(t)) < parallel && std::abs(ns.dot(pair.p_a - pair.p_b)) > 0.999 * pair.distance) {
    add_overlap(s, t, threshold, -ns, pair.triangle_b, points);
  } else if (on_face(s, pair.p_a) || on_face(t, pair.p_b) || pair.distance <= 2e-5 || nearest(pair)) {
    points.push_back({pair.p_a, n, pair.distance, pair.triangle_b});
  }
}

}  // namespace

std::vector<TouchPoint> find_touch_points(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL,
                                          double threshold, const DistanceField& field,
                                          const SeparationFront& front) {
  std::vector<ClosestPair> pairs;
  front.for_each_pair_within(solid, link, X_SL, threshold, field,
                             [&](const ClosestPair& pair) { pairs.push_back(pair); });
  // The order of the search depends on what was known before.
  std::ranges::sort(pairs, {}, [](const ClosestPair& p) { return std::pair(p.triangle_b, p.triangle_a); });
  std::vector<TouchPoint> points;
  const auto nearest = [&](const ClosestPair& p) {
    return nearest_to_each_other(solid, link, X_SL, p, pairs);
  };
  for (const ClosestPair& pair : pairs) add_touches(solid, link, X_SL, pair, threshold, nearest, points);
  return points;
}

std::vector<TouchPoint> find_touch_points(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL,
                                          double threshold, const PairHint& triangles) {
  std::vector<TouchPoint> points;
  if (triangles.triangle_a < 0) return points;
  ClosestPair pair;
  pair.triangle_a = triangles.triangle_a;
  pair.triangle_b = triangles.triangle_b;
  pair.distance = closest_points_of_triangles(solid.corners(pair.triangle_a),
                                              posed(X_SL, link.corners(pair.triangle_b)), pair.p_a, pair.p_b);
  const auto nearest = [&](const ClosestPair& p) { return nearest_to_each_other(solid, link, X_SL, p); };
  if (pair.distance <= threshold) add_touches(solid, link, X_SL, pair, threshold, nearest, points);
  return points;
}

}  // namespace eigengrasp
