// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/closest_points_step.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "shape/alignment_measures.hpp"

namespace eigengrasp {

namespace {

/// The small motion (rotation vector about the centre, then shift in sizes) that brings the pairs nearest.
Vec6 plane_step(const std::vector<PointPair>& pairs, const Vec3& center, double size) {
  Eigen::Matrix<double, 6, 6> normal_matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Vec6 right = Vec6::Zero();
  for (const PointPair& pair : pairs) {
    Vec6 row;
    row << ((pair.moved - center) / size).cross(pair.normal), pair.normal;
    const double gap = pair.normal.dot(pair.fixed - pair.moved) / size;
    normal_matrix += row * row.transpose();
    right += gap * row;
  }
  constexpr double damping = 1e-3;
  normal_matrix.diagonal().array() += damping * static_cast<double>(pairs.size());
  return normal_matrix.ldlt().solve(right);
}

Alignment moved_by(const Alignment& alignment, const Vec6& step, double size) {
  Alignment moved = alignment;
  const Vec3 turn = step.head<3>();
  const double angle = turn.norm();
  if (angle > 0.0) moved.R = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * alignment.R;
  moved.R = Eigen::Quaterniond(moved.R).normalized().toRotationMatrix();
  moved.center_target += size * step.tail<3>();
  return moved;
}

}  // namespace

Alignment refine_by_closest_points(const AlignmentShape& model, const AlignmentShape& target,
                                   const Alignment& start, const AlignmentOptions& options) {
  Alignment now = start;
  std::vector<PointPair> pairs = nearest_pairs(model, target, now, options.one_sided);
  now.distance = pair_distance(pairs) / target.size;
  for (int i = 0; i < options.iterations; ++i) {
    Alignment next = moved_by(now, plane_step(pairs, now.center_target, target.size), target.size);
    std::vector<PointPair> next_pairs = nearest_pairs(model, target, next, options.one_sided);
    next.distance = pair_distance(next_pairs) / target.size;
    if (!(next.distance < now.distance)) break;
    const bool settled = next.distance > 0.999 * now.distance;
    now = next;
    pairs = std::move(next_pairs);
    if (settled) break;
  }
  return now;
}

}  // namespace eigengrasp
