// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string_view>

#include "eigengrasp/geometry/point_cloud.hpp"

namespace eigengrasp {

/// Points of a file's content as they stand there, those that are not finite among them; no units.
/// @throws Error with file, line (of a text), what was found, what was expected and how to mend it
PointCloud read_ply_points(const std::filesystem::path& file, std::string_view content);
PointCloud read_obj_points(const std::filesystem::path& file, std::string_view content);
PointCloud read_pcd_points(const std::filesystem::path& file, std::string_view content);

/// Whether a PLY file's head tells of no face.
bool ply_has_no_faces(const std::filesystem::path& file, std::string_view content);

}  // namespace eigengrasp
