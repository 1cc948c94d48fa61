// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Inner spheres of the links of the hands of data/hands against points of their surfaces, by brute force.
#include <gtest/gtest.h>

#include <iostream>

#include "eigengrasp/geometry/sphere_cover.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"

namespace eigengrasp {
namespace {

/// Largest distance of a point of the surface from the spheres, over samples at 0.3 mm.
double farthest_point(const TriangleMesh& mesh, const std::vector<Sphere>& spheres) {
  const std::vector<Vec3> points = sample_surface(mesh, 0.0003).points;
  double farthest = 0.0;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 3001) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres) nearest = std::min(nearest, (s.center - points[i]).norm() - s.radius);
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(InnerSpheres, ReachTheSurfaceOfEveryShippedHandVsBruteForce) {
  const double tolerance = 0.0007;
  for (const NamedModel& named : list_hands()) {
    std::size_t count = 0;
    const HandModel hand = load_hand(named.path);
    for (const HandLink& link : hand.links) {
      if (link.mesh.empty()) continue;
      const MeshBvh bvh(link.mesh);
      const auto spheres = cover_with_inner_spheres(link.mesh, bvh, tolerance);
      count += spheres.size();
      EXPECT_LT(farthest_point(link.mesh, spheres), 1.1 * tolerance) << named.name << " " << link.name;
      for (const Sphere& s : spheres)
        EXPECT_LE(bvh.signed_distance(s.center), -s.radius + 1e-6) << named.name << " " << link.name;
    }
    std::cout << named.name << ": " << count << " inner spheres\n";
  }
}

}  // namespace
}  // namespace eigengrasp
