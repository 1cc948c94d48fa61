// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "eigengrasp/geometry/point_cloud.hpp"
#include "eigengrasp/render/camera.hpp"

namespace eigengrasp {

/// A simulated depth camera: one ray through the middle of each pixel.
struct DepthCamera {
  Camera camera;      ///< in the frame of the mesh; its aspect should be columns / rows
  int columns = 320;  ///< >= 1
  int rows = 240;     ///< >= 1
  /// Standard deviation of the depth at 1 m [m], growing with the square of the depth, as that of stereo and
  /// structured light does.
  double noise = 0.001;
  double least_cosine = 0.1;  ///< surfaces that are seen flatter than this give no depth
};

/// The points that it sees of a mesh, with its position as viewpoint; maybe none. The same seed gives the
/// same noise. Cost: about 0.1 us a pixel.
PointCloud take_depth_view(const TriangleMesh& mesh, const DepthCamera& camera, std::uint64_t seed);

/// The open surface that each of the cameras sees of a mesh, without noise: the corners of a triangle of
/// neighbouring pixels are joined unless their distances differ by more than those of neighbours on a surface
/// that is seen at the least cosine. Maybe empty. Cost: about 0.2 us a pixel, and 1 us a triangle of
/// the mesh.
std::vector<TriangleMesh> take_surface_views(const TriangleMesh& mesh, std::span<const DepthCamera> cameras);

}  // namespace eigengrasp
