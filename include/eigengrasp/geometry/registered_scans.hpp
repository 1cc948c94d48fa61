// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eigengrasp/geometry/point_cloud.hpp"

namespace eigengrasp {

/// Scans of one object, each seen from another side, in one frame.
struct RegisteredScans {
  std::vector<PointCloud> views;
  std::vector<std::string> names;    ///< of the views: their files without folder and ending
  std::vector<std::string> missing;  ///< files that are listed and not there
};

/// Whether the file lists scans and how they lie to each other: one that ends in .conf.
bool is_registered_scans_file(const std::filesystem::path& file);

/// Reads a list of range scans as the Stanford 3D Scanning Repository has them: lines
///     bmesh FILE tx ty tz qx qy qz qw
/// a file beside the list, a translation [unit] and a quaternion whose inverse turns the scan: x = q^-1 p +
/// t. A scan's sensor looks along -z of its frame, from 1 m. Lines "camera ..." are for renderers. Files that
/// are not there are left out.
/// @param scale metres of one unit @throws Error with file, line, what was found and what was expected; where
/// none of the scans is there; and as load_point_cloud
RegisteredScans load_registered_scans(const std::filesystem::path& file, double scale = 1.0);

/// The views of a scanned object: several of a list of registered scans, one of a cloud of points.
/// @throws Error as the readers of either
std::vector<PointCloud> load_views(const std::filesystem::path& file, double scale = 1.0);

}  // namespace eigengrasp
