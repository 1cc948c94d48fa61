// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <vector>

#include "eigengrasp/modeling/solid.hpp"

namespace eigengrasp::modeling {

/// Cross-section of a loft: a superellipse of four quarters about a centre, from lo to hi along its own y and
/// z, which are turned by roll about the centre.
struct LoftSection {
  double at = 0.0;                                   ///< place along the x axis [m]
  Eigen::Vector2d lo = Eigen::Vector2d::Zero();      ///< lowest y and z [m]
  Eigen::Vector2d hi = Eigen::Vector2d::Zero();      ///< highest y and z [m]
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< where the quarters meet; within lo..hi
  double power = 2.0;                                ///< 2: ellipse; towards 8: box
  double roll = 0.0;  ///< the section turned about the spine, y towards z [rad]
};

/// Body through sections along the x axis, smooth between them; its ends are domes of length caps[0] and
/// caps[1]. First-order distance.
/// @pre at least two sections, at ascending, lo < center < hi, power >= 1
Solid loft(const std::vector<LoftSection>& sections, const std::array<double, 2>& caps);

}  // namespace eigengrasp::modeling
