// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Queries of two hierarchies.
#include <algorithm>
#include <cmath>

#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "geometry/box_descent.hpp"

namespace eigengrasp {

namespace {

TriangleCorners posed(const Pose& X, const TriangleCorners& t) {
  return {X * t.a, X * t.b, X * t.c};
}

double squared_distance(const Box& a, const Box& b) {
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Vec3::Zero()).squaredNorm();
}

Box box_of(const TriangleCorners& t) {
  return {t.a.cwiseMin(t.b).cwiseMin(t.c), t.a.cwiseMax(t.b).cwiseMax(t.c)};
}

/// Visits the pairs of triangles of two leaves of which the boxes are no farther apart than bound2(). Stops
/// where visit returns true, and returns that.
template <typename Bound, typename Visit>
bool visit_triangles(const MeshBvh& a, const MeshBvh::Node& na, const MeshBvh& b, const MeshBvh::Node& nb,
                     const Pose& X_AB, Bound bound2, Visit visit) {
  for (int j = nb.left; j < nb.left + nb.count; ++j) {
    const int tb = b.triangle_at(j);
    const TriangleCorners t = posed(X_AB, b.corners(tb));
    const Box box = box_of(t);
    if (squared_distance(na.box, box) > bound2()) continue;
    for (int i = na.left; i < na.left + na.count; ++i) {
      const int ta = a.triangle_at(i);
      const TriangleCorners& s = a.corners(ta);
      if (squared_distance(box_of(s), box) <= bound2() && visit(ta, s, tb, t)) return true;
    }
  }
  return false;
}

}  // namespace

bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB) {
  const auto bound = [] { return 0.0; };  // and its square
  bool found = false;
  detail::descend(a, b, X_AB, bound, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    return visit_triangles(a, na, b, nb, X_AB, bound,
                           [&](int, const TriangleCorners& s, int, const TriangleCorners& t) {
                             return found = triangles_cross(s, t);
                           });
  });
  return found;
}

ClosestPair closest_pair(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                         PairHint* hint) {
  ClosestPair best;
  best.distance = max_distance;
  const auto bound = [&] { return best.distance; };
  const auto bound2 = [&] { return best.distance * best.distance; };
  const auto visit = [&](int ta, const TriangleCorners& s, int tb, const TriangleCorners& t) {
    if (plane_separates(s, t, best.distance)) return false;
    Vec3 p;
    Vec3 q;
    const double d = closest_points_of_triangles(s, t, p, q);
    if (d < best.distance) best = {p, q, d, ta, tb};
    return best.triangle_a >= 0 && best.distance == 0.0;
  };
  if (hint && hint->triangle_a >= 0)
    visit(hint->triangle_a, a.corners(hint->triangle_a), hint->triangle_b,
          posed(X_AB, b.corners(hint->triangle_b)));
  detail::descend(a, b, X_AB, bound, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    return visit_triangles(a, na, b, nb, X_AB, bound2, visit);
  });
  if (hint && best.triangle_a >= 0) *hint = {best.triangle_a, best.triangle_b};
  return best;
}

void for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                          const std::function<void(const ClosestPair&)>& visit) {
  const auto bound = [&] { return max_distance; };
  const auto bound2 = [&] { return max_distance * max_distance; };
  detail::descend(a, b, X_AB, bound, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    return visit_triangles(a, na, b, nb, X_AB, bound2,
                           [&](int ta, const TriangleCorners& s, int tb, const TriangleCorners& t) {
                             if (plane_separates(s, t, max_distance)) return false;
                             ClosestPair pair;
                             pair.distance = closest_points_of_triangles(s, t, pair.p_a, pair.p_b);
                             pair.triangle_a = ta;
                             pair.triangle_b = tb;
                             if (pair.distance <= max_distance) visit(pair);
                             return false;
                           });
  });
}

}  // namespace eigengrasp
