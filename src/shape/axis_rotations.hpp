// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/shape/shape_alignment.hpp"

namespace eigengrasp {

/// Rotations that lay the model's principal axes upon the target's: 4 choices of signs; with quarter turns
/// among axes whose deviations are about equal in one of the shapes (8, 24). With eighth turns, twice as many
/// where any are equal.
std::vector<Mat3> axis_rotations(const AlignmentShape& model, const AlignmentShape& target, double equal_axes,
                                 bool eighth_turns);

}  // namespace eigengrasp
