// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// A rigid object to grasp or to avoid. Immutable, shared by all threads.
struct ObjectModel {
  std::string name;
  std::filesystem::path source;
  TriangleMesh mesh;                   ///< in the object frame O [m]
  MeshBvh bvh;                         ///< of the mesh
  Vec3 center_of_mass = Vec3::Zero();  ///< in O [m]
  double max_radius = 0.0;  ///< largest distance of a vertex from the centre of mass [m]: the torque scale
  std::string material;     ///< of the friction table; empty: unknown
  bool watertight = false;
  /// Of a scan: the part of the surface that was seen, in O [m]; the rest is guessed. None: all is known.
  std::shared_ptr<const TriangleMesh> seen;

  // One distance field serves all scales of an object.
  double scale = 1.0;                     ///< of the mesh; 1 is the mesh that the distance field is made of
  std::string content_key;                ///< of the mesh at scale 1
  std::shared_ptr<const MeshBvh> at_one;  ///< of the mesh at scale 1; none where this is it

  const MeshBvh& unscaled_bvh() const { return at_one ? *at_one : bvh; }
};

/// Prepares a mesh. The centre of mass is the volume's where the mesh is watertight with positive volume,
/// else the surface's, unless given. @throws Error for an empty mesh, non-finite vertices or indices out of
/// range.
ObjectModel make_object(std::string name, TriangleMesh mesh, const Vec3* center_of_mass = nullptr);

/// The object made `factor` times larger about its origin. @pre factor > 0
ObjectModel rescaled(const ObjectModel& object, double factor);

/// What tells meshes apart: a hash of vertices and triangles.
std::string content_key_of(const TriangleMesh& mesh);

}  // namespace eigengrasp
