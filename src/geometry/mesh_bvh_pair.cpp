// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Queries of two hierarchies: simultaneous descent, the larger node first.
#include <algorithm>
#include <cmath>

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp {

namespace {

/// Boxes and triangles of b as seen from the frame of a.
class PosedBvh {
 public:
  PosedBvh(const MeshBvh& bvh, const Pose& X_AB) : bvh_(bvh), X_AB_(X_AB), abs_R_(X_AB.linear().cwiseAbs()) {}

  Box box(int node) const {
    const Box& box = bvh_.nodes()[static_cast<std::size_t>(node)].box;
    const Vec3 center = X_AB_ * box.center();
    const Vec3 half = abs_R_ * (0.5 * box.size());
    return {center - half, center + half};
  }
  TriangleCorners corners(int t) const {
    const TriangleCorners& c = bvh_.corners(t);
    return {X_AB_ * c.a, X_AB_ * c.b, X_AB_ * c.c};
  }

 private:
  const MeshBvh& bvh_;
  const Pose& X_AB_;
  Mat3 abs_R_;
};

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
                     const PosedBvh& posed_b, Bound bound2, Visit visit) {
  for (int j = nb.left; j < nb.left + nb.count; ++j) {
    const int tb = b.triangle_at(j);
    const TriangleCorners t = posed_b.corners(tb);
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

struct NodePair {
  int a;
  int b;
  double distance2;
};

/// Descends both trees; visits leaf pairs of which the boxes are no farther apart than bound2() (which may
/// shrink). Stops where visit_leaves returns true.
template <typename Bound, typename VisitLeaves>
void descend(const MeshBvh& a, const MeshBvh& b, const PosedBvh& posed_b, Bound bound2,
             VisitLeaves visit_leaves) {
  if (a.empty() || b.empty()) return;
  NodePair stack[256];
  int top = 0;
  stack[top++] = {0, 0, squared_distance(a.box(), posed_b.box(0))};
  while (top > 0) {
    const NodePair pair = stack[--top];
    if (pair.distance2 > bound2()) continue;
    const MeshBvh::Node& na = a.nodes()[static_cast<std::size_t>(pair.a)];
    const MeshBvh::Node& nb = b.nodes()[static_cast<std::size_t>(pair.b)];
    if (na.count > 0 && nb.count > 0) {
      if (visit_leaves(na, nb)) return;
      continue;
    }
    NodePair near;
    NodePair far;
    const bool split_a =
        nb.count > 0 || (na.count == 0 && na.box.size().squaredNorm() >= nb.box.size().squaredNorm());
    if (split_a) {
      const Box box_b = posed_b.box(pair.b);
      const auto left = static_cast<std::size_t>(na.left);
      near = {na.left, pair.b, squared_distance(a.nodes()[left].box, box_b)};
      far = {na.left + 1, pair.b, squared_distance(a.nodes()[left + 1].box, box_b)};
    } else {
      near = {pair.a, nb.left, squared_distance(na.box, posed_b.box(nb.left))};
      far = {pair.a, nb.left + 1, squared_distance(na.box, posed_b.box(nb.left + 1))};
    }
    if (far.distance2 < near.distance2) std::swap(near, far);
    if (far.distance2 <= bound2()) stack[top++] = far;
    if (near.distance2 <= bound2()) stack[top++] = near;
  }
}

}  // namespace

bool intersects(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB) {
  const PosedBvh posed_b(b, X_AB);
  const auto bound2 = [] { return 0.0; };
  bool found = false;
  descend(a, b, posed_b, bound2, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    return visit_triangles(a, na, b, nb, posed_b, bound2,
                           [&](int, const TriangleCorners& s, int, const TriangleCorners& t) {
                             return found = triangles_cross(s, t);
                           });
  });
  return found;
}

ClosestPair closest_pair(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                         PairHint* hint) {
  const PosedBvh posed_b(b, X_AB);
  ClosestPair best;
  best.distance = max_distance;
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
    visit(hint->triangle_a, a.corners(hint->triangle_a), hint->triangle_b, posed_b.corners(hint->triangle_b));
  descend(a, b, posed_b, bound2, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    return visit_triangles(a, na, b, nb, posed_b, bound2, visit);
  });
  if (hint && best.triangle_a >= 0) *hint = {best.triangle_a, best.triangle_b};
  return best;
}

void for_each_pair_within(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, double max_distance,
                          const std::function<void(const ClosestPair&)>& visit) {
  const PosedBvh posed_b(b, X_AB);
  const auto bound2 = [&] { return max_distance * max_distance; };
  descend(a, b, posed_b, bound2, [&](const MeshBvh::Node& na, const MeshBvh::Node& nb) {
    return visit_triangles(a, na, b, nb, posed_b, bound2,
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
