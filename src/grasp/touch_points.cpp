// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cmath>

#include "eigengrasp/grasp/contact_finder.hpp"

namespace eigengrasp {

namespace {

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

}  // namespace

std::vector<TouchPoint> find_touch_points(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL,
                                          double threshold) {
  std::vector<TouchPoint> points;
  for_each_pair_within(solid, link, X_SL, threshold, [&](const ClosestPair& pair) {
    const TriangleCorners& local = link.corners(pair.triangle_b);
    const TriangleCorners posed{X_SL * local.a, X_SL * local.b, X_SL * local.c};
    const Vec3 n = contact_normal(pair, solid.corners(pair.triangle_a), posed);
    if (n.squaredNorm() > 0.5) points.push_back({pair.p_a, n, pair.distance});
  });
  return points;
}

}  // namespace eigengrasp
