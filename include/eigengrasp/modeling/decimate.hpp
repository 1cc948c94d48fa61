// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <limits>

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp::modeling {

struct DecimateOptions {
  std::size_t target_triangles = 0;  ///< stops at this number (or one less)
  /// Stops where every further collapse would move the surface by more than about this [m].
  double max_error = std::numeric_limits<double>::infinity();
  double max_edge = std::numeric_limits<double>::infinity();  ///< no edge longer than this is made [m]
  double min_normal_cosine = 0.5;  ///< largest turn of a triangle by one collapse, as a cosine
  double min_quality = 0.15;       ///< 4 sqrt(3) area / sum of squared edges; 1 is equilateral; see below
  double shape_weight = 1e-4;      ///< pull towards even triangles where the surface is flat [-]
};

/// Edge collapse in the order of the quadric error (Garland and Heckbert 1997). Keeps the mesh closed and
/// manifold (link condition), turns no triangle over, makes no triangle worse than min_quality unless it was
/// worse before.
/// @pre the mesh is closed and manifold. Deterministic.
void decimate(TriangleMesh& mesh, const DecimateOptions& options);

}  // namespace eigengrasp::modeling
