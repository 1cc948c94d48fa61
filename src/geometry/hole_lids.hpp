// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// Triangles that close the holes of a surface: a fan about the middle of each loop of edges that have a
/// triangle on one side only. Vertices within 1 um of each other are one. Empty for a closed surface. Cost:
/// that of some sorting.
TriangleMesh make_hole_lids(const TriangleMesh& mesh);

}  // namespace eigengrasp
