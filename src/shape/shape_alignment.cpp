// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/shape/shape_alignment.hpp"

#include <algorithm>
#include <stdexcept>

#include "shape/alignment_measures.hpp"
#include "shape/axis_rotations.hpp"
#include "shape/closest_points_step.hpp"

namespace eigengrasp {

namespace {

void check(const AlignmentShape& model, const AlignmentShape& target, const AlignmentOptions& options) {
  if (model.points.empty() || target.points.empty()) throw std::logic_error("a shape that was not made");
  if (!(options.equal_axes >= 1.0) || options.seeds < 1 || options.iterations < 1)
    throw std::logic_error("alignment options out of bounds");
}

/// Every candidate with its overlap, best first; of equal ones the earlier.
std::vector<Alignment> ranked(const AlignmentShape& model, const AlignmentShape& target,
                              const AlignmentOptions& options, bool eighth_turns) {
  const double reach = common_reach(model, target);
  const ZernikeMoments fixed = overlap_moments(target, Mat3::Identity(), reach);
  std::vector<Alignment> all;
  for (const Mat3& R : axis_rotations(model, target, options.equal_axes, eighth_turns)) {
    Alignment a;
    a.method = kPcaAlignment;
    a.R = R;
    a.center_model = model.center;
    a.center_target = target.center;
    a.scale = options.match_scale ? target.size / model.size : 1.0;
    a.overlap = correlation(overlap_moments(model, R, reach), fixed);
    all.push_back(a);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Alignment& a, const Alignment& b) { return a.overlap > b.overlap; });
  for (Alignment& a : all) a.candidates = static_cast<int>(all.size());
  return all;
}

}  // namespace

Eigen::Matrix4d Alignment::matrix(double with_scale) const {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X.topLeftCorner<3, 3>() = with_scale * R;
  X.topRightCorner<3, 1>() = center_target - with_scale * (R * center_model);
  return X;
}

Alignment align_by_pca(const AlignmentShape& model, const AlignmentShape& target,
                       const AlignmentOptions& options) {
  check(model, target, options);
  Alignment best = ranked(model, target, options, false).front();
  best.distance = pair_distance(nearest_pairs(model, target, best, options.one_sided)) / target.size;
  return best;
}

Alignment align_by_icp(const AlignmentShape& model, const AlignmentShape& target,
                       const AlignmentOptions& options) {
  check(model, target, options);
  const std::vector<Alignment> all = ranked(model, target, options, true);
  Alignment best = align_by_pca(model, target, options);
  const std::size_t seeds = std::min(all.size(), static_cast<std::size_t>(options.seeds));
  std::vector<Alignment> starts(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(seeds));
  starts.push_back(best);
  for (const Alignment& start : starts) {
    const Alignment refined = refine_by_closest_points(model, target, start, options);
    if (refined.distance < best.distance) best = refined;
  }
  const double reach = common_reach(model, target);
  best.method = kIcpAlignment;
  best.candidates = static_cast<int>(all.size());
  best.overlap =
      correlation(overlap_moments(model, best.R, reach), overlap_moments(target, Mat3::Identity(), reach));
  return best;
}

}  // namespace eigengrasp
