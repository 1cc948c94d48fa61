// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/modeling/solid.hpp"

namespace eigengrasp::modeling {

struct PolygoniseOptions {
  int n_threads = 0;         ///< 0: all; the mesh does not depend on it
  int relax_iterations = 2;  ///< rounds of tangential smoothing and projection
  bool sharpen = true;       ///< puts vertices beside sharp edges onto them
};

/// The zero set of the distance as one closed, manifold, outward mesh: marching tetrahedra on a grid of width
/// cell [m], vertices then evened out along the surface and projected onto it. Details thinner than about two
/// cells may be lost. Gives many small triangles (some 10 a cell of surface): decimate() afterwards.
/// Components are all kept.
/// @throws std::logic_error where the surface leaves the box of the solid or there is no surface.
TriangleMesh polygonise(const Solid& solid, double cell, const PolygoniseOptions& options = {});

}  // namespace eigengrasp::modeling
