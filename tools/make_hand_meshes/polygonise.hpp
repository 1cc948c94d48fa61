// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "solid.hpp"

namespace eigengrasp::shapes {

/// Closed, outward-oriented manifold of the zero set: marching tetrahedra on a grid of the given cell size
/// [m], every vertex put onto the surface. Details below about two cells are lost.
TriangleMesh polygonise(const Solid& solid, double cell);

/// Collapses edges, cheapest first by the quadric error (Garland and Heckbert 1997), until at most
/// max_triangles are left or no edge can go without harm; stays a closed manifold. New vertices are put onto
/// the surface of the solid.
TriangleMesh decimate(const TriangleMesh& mesh, const Solid& solid, std::size_t max_triangles);

/// Turns edges and moves vertices along the surface until the triangles are rounder; keeps their number.
void improve(TriangleMesh& mesh, const Solid& solid, int rounds);

/// Throws Error where the mesh is not closed, an edge has more than two triangles, or its volume is not
/// positive.
void require_closed_manifold(const TriangleMesh& mesh, const std::string& name);

}  // namespace eigengrasp::shapes
