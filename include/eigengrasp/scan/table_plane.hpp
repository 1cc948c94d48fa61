// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// A plane that things stand on.
struct TablePlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit, up: towards the sensor
  double height = 0.0;          ///< normal . p of its points [m]

  double above(const Vec3& p) const { return normal.dot(p) - height; }
};

/// The plane that holds the most points, if they are a fifth of all at least and what is not on it stands
/// above it: RANSAC of 400 triples (always the same), then a plane fitted to what lies within `tolerance`
/// [m].
/// @param viewpoint of the sensor, which is above the table
std::optional<TablePlane> find_table(const std::vector<Vec3>& points, const Vec3& viewpoint,
                                     double tolerance);

/// The largest group of points above the plane: farther than `clearance` [m] from it, and connected by steps
/// of at most `reach` [m].
std::vector<Vec3> object_above(const TablePlane& table, const std::vector<Vec3>& points, double clearance,
                               double reach);

}  // namespace eigengrasp
