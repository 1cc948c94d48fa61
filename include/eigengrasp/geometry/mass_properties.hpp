// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// What a mesh is as a solid.
struct MeshReport {
  /// Every edge is walked as often in one direction as in the other (welded), so that the volume integral
  /// does not depend on its origin. True also where two sheets of a closed surface touch in an edge.
  bool watertight = false;
  bool consistent_orientation = false;  ///< no two triangles walk an edge in the same direction
  int components = 0;                   ///< connected through shared (welded) vertices
  int boundary_edges = 0;
  int non_manifold_edges = 0;
  int degenerate_triangles = 0;  ///< zero area
  double area = 0.0;             ///< [m^2]
  double volume = 0.0;           ///< signed [m^3], sum of signed tetrahedra; means nothing for a soup
  Box box;
  Vec3 surface_center = Vec3::Zero();  ///< area-weighted [m]
  Vec3 volume_center = Vec3::Zero();   ///< volume-weighted [m]; zero where the volume is 0
  /// The volume integral is sound: watertight and positive volume.
  bool solid() const { return watertight && volume > 0.0; }
  Vec3 center_of_mass() const { return solid() ? volume_center : surface_center; }
};

/// Cost: linear in the triangles. @pre indices in range, finite vertices.
MeshReport inspect_mesh(const TriangleMesh& mesh);

/// Throws Error (a sentence that begins with `what`) for a mesh without triangles, non-finite vertices, or
/// faces that index beyond the vertices.
void require_sound_mesh(const TriangleMesh& mesh, const std::string& what);

}  // namespace eigengrasp
