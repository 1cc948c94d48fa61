// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <vector>

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// Unit normals of the triangles' corners: the triangles around a vertex share one where they meet at less
/// than the crease angle [rad]. Vertices at the same place count as one.
std::vector<std::array<Vec3, 3>> corner_normals_of(const TriangleMesh& mesh, double crease_angle);

}  // namespace eigengrasp
