// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// Points of a surface as a depth camera or a scanner saw them, in the frame of their file [m].
struct PointCloud {
  std::vector<Vec3> points;       ///< finite
  std::optional<Vec3> viewpoint;  ///< where the sensor stood [m], if the file says so
  std::size_t dropped = 0;        ///< points of the file that were not finite: what the sensor did not see
};

/// Reads PLY (text, binary), PCD (ascii, binary, binary_compressed; a VIEWPOINT other than the origin with no
/// turn, which stands for "not known", is taken over) and OBJ (its vertices). Faces are not looked at.
/// @param scale metres of one unit @throws Error with file, line of a text, what was found, what was expected
/// and how to mend it: for no such file, damaged or cut ones, and those without a finite point
PointCloud load_point_cloud(const std::filesystem::path& file, double scale = 1.0);

/// Whether the file holds points without faces: any PCD, a PLY or OBJ with vertices and no face. False for
/// files that cannot be read, which a reader then explains.
bool is_point_cloud_file(const std::filesystem::path& file);

/// Median distance of a point to its nearest other point [m]; of 500 of them; 0 where all are one
/// and the same. @pre two points at least
double point_spacing(const std::vector<Vec3>& points);

}  // namespace eigengrasp
