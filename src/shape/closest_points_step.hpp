// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/shape/shape_alignment.hpp"

namespace eigengrasp {

/// Iterative closest points from a start until the distance no longer falls: never worse than the start. Each
/// step solves the linearised sum of squared distances to the planes at the nearest points (Chen and Medioni
/// 1992) with some damping, as round shapes leave rotations free. Scale is kept; `distance` is set.
Alignment refine_by_closest_points(const AlignmentShape& model, const AlignmentShape& target,
                                   const Alignment& start, const AlignmentOptions& options);

}  // namespace eigengrasp
