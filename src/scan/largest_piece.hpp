// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// Drops all triangles but those of the connected piece with the largest area.
void keep_largest_piece(TriangleMesh& mesh);

}  // namespace eigengrasp
