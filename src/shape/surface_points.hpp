// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

struct SurfacePoints {
  std::vector<Vec3> points;   ///< [m]
  std::vector<Vec3> normals;  ///< unit
};

/// Points spread over a surface, each for the same area, always the same ones. @pre the surface has an area
SurfacePoints spread_points(const TriangleMesh& mesh, int count);

/// Area, centre [m] and mean of (p - centre) (p - centre)^T [m^2] of a surface, exact.
struct SurfaceSpread {
  double area = 0.0;
  Vec3 center = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();
};
SurfaceSpread surface_spread(const TriangleMesh& mesh);

}  // namespace eigengrasp
