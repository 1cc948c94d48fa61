// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// Closed meshes about the origin, counter-clockwise seen from outside; all vertices lie on the shape.
TriangleMesh box_mesh(const Vec3& sides);
/// Axis z, 64 sides.
TriangleMesh cylinder_mesh(double radius, double length);
/// 64 meridians, 31 parallels.
TriangleMesh sphere_mesh(double radius);

}  // namespace eigengrasp
