// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/shape/shape_alignment.hpp"
#include "eigengrasp/shape/zernike_moments.hpp"

namespace eigengrasp {

/// Moments (order 10) of a shape's points, turned by R, in a ball of radius `reach` (in sizes).
ZernikeMoments overlap_moments(const AlignmentShape& shape, const Mat3& R, double reach);

/// Correlation of two functions on the ball from their moments, in [-1, 1].
double correlation(const ZernikeMoments& a, const ZernikeMoments& b);

/// The largest distance of both shapes' points from their centres, over their sizes.
double common_reach(const AlignmentShape& a, const AlignmentShape& b);

/// A point of one surface, the nearest point of the other, and the normal there; in the target's frame [m].
struct PointPair {
  Vec3 moved, fixed, normal;  ///< the motion of the model moves `moved` relative to `fixed`
};

/// From the model's points to the target and, unless one_sided, from the target's to the model. One-sided:
/// from those points that were seen.
std::vector<PointPair> nearest_pairs(const AlignmentShape& model, const AlignmentShape& target,
                                     const Alignment& alignment, bool one_sided);

/// Root mean square distance [m].
double pair_distance(const std::vector<PointPair>& pairs);

}  // namespace eigengrasp
