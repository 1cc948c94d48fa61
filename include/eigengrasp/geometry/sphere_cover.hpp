// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

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

/// Spheres inside a closed surface that together reach its points to within about `tolerance` [m]: medial
/// balls (shrinking-ball construction, Ma et al. 2012) chosen greedily. The tolerance holds at samples at
/// least 1.2 mm apart, and at most of them where there are more than 1,500; between them gaps of up to twice
/// the tolerance are possible. What meets a sphere is inside the solid; what intrudes deeper than that meets
/// a sphere. Cost: some 10 ms.
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

/// A small ball that holds all points (Ritter 1990; at most some per cent larger than the smallest).
Sphere bounding_sphere(const std::vector<Vec3>& points);

}  // namespace eigengrasp
