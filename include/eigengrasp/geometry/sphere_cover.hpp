// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>
#include <vector>

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp {

struct Sphere {
  Vec3 center = Vec3::Zero();  ///< [m]
  double radius = 0.0;         ///< [m]
};

/// Points of the surface, at least one in every triangle, with a spacing of about the given one [m], and
/// their unit normals. Deterministic.
struct SurfaceSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
};
SurfaceSamples sample_surface(const TriangleMesh& mesh, double spacing);

/// Spheres inside a closed surface that together reach its points: medial balls (shrinking-ball construction,
/// Ma et al. 2012) chosen greedily, the largest first. What meets a sphere is inside the solid; what intrudes
/// deeper than the tolerance meets a sphere.
/// Holes are closed by lids that no sphere crosses; the lids themselves need not be reached.
/// Guarantee: cut the surface into pieces of at most 0.4 tolerances (a thousandth of the root of its area
/// where that is more). Every piece that has the solid on one side is within `tolerance` [m] of a sphere as a
/// whole, or at least its centre is; no point is therefore farther than 1.27 tolerances, and nearly none
/// farther than 1.05. Surfaces hidden inside the solid (probed every 1.6 pieces' sides) need not be reached.
/// Cost: some 10 ms for a finger's link at 0.7 mm; 0.2-0.5 s for a hand.
std::vector<Sphere> cover_with_inner_spheres(const TriangleMesh& mesh, const MeshBvh& bvh, double tolerance);

/// Neighbouring spheres and a ball that holds them all.
struct SphereGroup {
  Sphere bound;
  int first = 0;  ///< of the ordered spheres
  int count = 0;
};

/// Orders spheres so that neighbours stand together, in groups of at most group_size, by halving along the
/// longest side.
std::vector<SphereGroup> group_spheres(std::vector<Sphere>& spheres, int group_size);

/// A ball that holds all spheres, about the middle of their box.
Sphere bounding_sphere(std::span<const Sphere> spheres);

/// A small ball that holds all points (Ritter 1990; at most some per cent larger than the smallest).
Sphere bounding_sphere(const std::vector<Vec3>& points);

}  // namespace eigengrasp
