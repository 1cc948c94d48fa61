// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/distance_field.hpp"

namespace eigengrasp {

/// Sets every node of the grid to its unsigned distance to the surface, exact to 1e-7 of the distance.
/// Cost: about 0.3 us a node. The result does not depend on the number of threads.
/// @pre a hierarchy that is not empty
void fill_unsigned_distances(const MeshBvh& bvh, FieldGrid& grid, int threads);

}  // namespace eigengrasp
