// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// Where the sensor of a view may have stood, told from the points alone: no point hides another from there,
/// so of all directions the picture has the most pixels in it; and the surface bulges towards it. The
/// distance cannot be told: six diagonals of the cloud are taken. Off by 10-30 degrees as a rule; a viewpoint
/// that is known is always better. Cost: about 20 ms. @pre three points at least, spacing > 0 [m]
Vec3 estimate_viewpoint(const std::vector<Vec3>& points, double spacing);

}  // namespace eigengrasp
