// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/alignment_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/moment_sum.hpp"

namespace eigengrasp {

namespace {

constexpr int overlap_order = 10;

Vec3 triangle_normal(const MeshBvh& bvh, int t) {
  const TriangleCorners& c = bvh.corners(t);
  const Vec3 n = (c.b - c.a).cross(c.c - c.a);
  const double length = n.norm();
  return length > 0.0 ? Vec3(n / length) : Vec3::Zero();
}

/// A bound on how far p is from a surface that has these points, which makes the exact query quick.
double nearest_of(const std::vector<Vec3>& points, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& q : points) least = std::min(least, (q - p).squaredNorm());
  return std::sqrt(least);
}

ClosestPoint closest(const AlignmentShape& shape, const Vec3& p) {
  constexpr double rounding = 1e-9;
  const double bound = nearest_of(shape.points, (p - shape.center) / shape.size) + rounding;
  return shape.bvh.closest_point(p, bound * (1.0 + rounding) * shape.size);
}

}  // namespace

ZernikeMoments overlap_moments(const AlignmentShape& shape, const Mat3& R, double reach) {
  MomentSum sum(overlap_order);
  const Mat3 turn = R / reach;
  for (const Vec3& p : shape.points) sum.add(turn * p, 1.0);
  return sum.moments();
}

double correlation(const ZernikeMoments& a, const ZernikeMoments& b) {
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    aa += a.values()[i] * a.values()[i];
    bb += b.values()[i] * b.values()[i];
    ab += a.values()[i] * b.values()[i];
  }
  return ab / std::sqrt(aa * bb);
}

double common_reach(const AlignmentShape& a, const AlignmentShape& b) {
  double reach = 0.0;
  for (const AlignmentShape* shape : {&a, &b})
    for (const Vec3& p : shape->points) reach = std::max(reach, p.norm());
  return reach;
}

std::vector<PointPair> nearest_pairs(const AlignmentShape& model, const AlignmentShape& target,
                                     const Alignment& alignment, bool one_sided) {
  std::vector<PointPair> pairs;
  const Mat3& R = alignment.R;
  const double s = alignment.scale;
  for (const Vec3& p : one_sided && !model.seen.empty() ? model.seen : model.points) {
    const Vec3 moved = alignment.center_target + s * model.size * (R * p);
    const ClosestPoint near = closest(target, moved);
    pairs.push_back({moved, near.point, triangle_normal(target.bvh, near.triangle)});
  }
  if (one_sided) return pairs;
  for (const Vec3& p : target.points) {
    const Vec3 fixed = target.center + target.size * p;
    const Vec3 in_model = alignment.center_model + R.transpose() * (fixed - alignment.center_target) / s;
    const ClosestPoint near = closest(model, in_model);
    const Vec3 moved = alignment.center_target + s * (R * (near.point - alignment.center_model));
    pairs.push_back({moved, fixed, R * triangle_normal(model.bvh, near.triangle)});
  }
  return pairs;
}

double pair_distance(const std::vector<PointPair>& pairs) {
  double sum = 0.0;
  for (const PointPair& pair : pairs) sum += (pair.moved - pair.fixed).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

}  // namespace eigengrasp
