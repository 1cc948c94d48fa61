// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Queries of two hierarchies.
#include <algorithm>
#include <cmath>

#include "eigengrasp/geometry/mesh_motion.hpp"
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

namespace {

using detail::NodePair;
constexpr NodePair whole{0, 0, 0.0};

/// Puts those parts of b's node on the list, each with the root of a, that the field does not keep farther
/// away than `reach` [m].
void add_near_parts(const MeshBvh& b, int node, const Pose& X_AB, const DistanceField& field, double reach,
                    std::vector<NodePair>& near) {
  constexpr double least_part = 0.004;  // [m] smaller ones are left to boxes
  const MeshBvh::OrientedBox& box = b.oriented_box(node);
  const double radius = Vec3(box.half[0], box.half[1], box.half[2]).norm() * 1.00001;
  if (certain_distance(field, X_AB * Vec3(box.center[0], box.center[1], box.center[2])) > radius + reach)
    return;
  const MeshBvh::Node& n = b.nodes()[static_cast<std::size_t>(node)];
  if (n.count > 0 || radius < least_part) {
    near.push_back({0, node, 0.0});
  } else {
    add_near_parts(b, n.left, X_AB, field, reach, near);
    add_near_parts(b, n.left + 1, X_AB, field, reach, near);
  }
}

bool cross(std::span<const NodePair> starts, const MeshBvh& a, const MeshBvh& b, const Pose& X_AB) {
  const auto bound = [] { return 0.0; };  // and its square
  bool found = false;
  detail::descend_from(starts, a, b, X_AB, bound, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    return visit_triangles(a, na, b, nb, X_AB, bound,
                           [&](int, const TriangleCorners& s, int, const TriangleCorners& t) {
                             return found = triangles_cross(s, t);
                           });
  });
  return found;
}

}  // namespace

bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB) {
  return !a.empty() && !b.empty() && cross({&whole, 1}, a, b, X_AB);
}

bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, const DistanceField& field) {
  if (field.empty() || a.empty() || b.empty()) return intersects(a, b, X_AB);
  std::vector<NodePair> near;
  add_near_parts(b, 0, X_AB, field, 0.0, near);
  return cross(near, a, b, X_AB);
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

namespace {

void visit_pairs_within(std::span<const NodePair> starts, const MeshBvh& a, const MeshBvh& b,
                        const Pose& X_AB, double max_distance,
                        const std::function<void(const ClosestPair&)>& visit) {
  const auto bound = [&] { return max_distance; };
  const auto bound2 = [&] { return max_distance * max_distance; };
  detail::descend_from(starts, a, b, X_AB, bound, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
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

}  // namespace

void for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                          const std::function<void(const ClosestPair&)>& visit) {
  if (!a.empty() && !b.empty()) visit_pairs_within({&whole, 1}, a, b, X_AB, max_distance, visit);
}

void SeparationFront::for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB,
                                           double max_distance, const DistanceField& field,
                                           const std::function<void(const ClosestPair&)>& visit) const {
  if (a.empty() || b.empty()) return;
  std::vector<NodePair> near;
  const auto add = [&](int node_a, int node_b) {
    if (node_a < 0 && !field.empty()) {
      add_near_parts(b, node_b, X_AB, field, max_distance, near);
    } else {
      near.push_back({std::max(node_a, 0), node_b, 0.0});
    }
  };
  if (parts_.empty()) add(-1, 0);
  for (const Parts& parts : parts_) add(parts.a, parts.b);
  visit_pairs_within(near, a, b, X_AB, max_distance, visit);
}

}  // namespace eigengrasp
