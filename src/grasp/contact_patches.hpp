// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/grasp/contact_finder.hpp"

namespace eigengrasp {

/// Splits touching points into regions: points belong together that are nearer than a few merge distances and
/// whose normals are within 25 degrees; each region is reduced to the corners of its perimeter, at least
/// `merge` [m] apart, all with the region's mean normal. Deterministic for the same points in the same order.
std::vector<std::vector<TouchPoint>> make_patches(std::vector<TouchPoint> points, double merge);

}  // namespace eigengrasp
