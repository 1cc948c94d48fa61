// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp::detail {

inline constexpr int most_points = 16;

/// The nearest triangle of each of sixteen points that are near each other: one walk through the hierarchy
/// instead of sixteen. Of triangles that share the nearest point that which faces the point most, so that
/// rounding does not decide.
/// @param about a place among the points  @param max_distance [m] -1 where all triangles are farther
/// Cost: 1-3 us.
std::array<int, most_points> find_nearest_triangles(const MeshBvh& bvh, const Vec3& about,
                                                    const std::array<Vec3, most_points>& points,
                                                    double max_distance);

}  // namespace eigengrasp::detail
