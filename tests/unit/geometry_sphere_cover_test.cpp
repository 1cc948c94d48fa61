// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Spheres inside solids, samples of their surface, curvature of it.
#include "eigengrasp/geometry/sphere_cover.hpp"

#include <gtest/gtest.h>

#include <array>

#include "eigengrasp/contact/contact_point.hpp"
#include "eigengrasp/geometry/curvature.hpp"
#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

struct Solid {
  const char* name;
  TriangleMesh mesh;
};

std::vector<Solid> solids() {
  return {{"ball", testing::ball_mesh(0.012, 24)},
          {"capsule", testing::capsule_mesh(0.008, 0.02)},
          {"box", testing::box_mesh({0.015, 0.02, 0.048})},
          {"torus", testing::torus_mesh(0.03, 0.008)},
          {"cup", testing::cup_mesh(0.03, 0.05, 0.004)}};
}

TEST(SphereCover, SpheresAreInsideAndReachTheSurface) {
  RandomStream random{1};
  const double tolerance = 0.0015;
  for (const Solid& solid : solids()) {
    const MeshBvh bvh(solid.mesh);
    const auto spheres = cover_with_inner_spheres(solid.mesh, bvh, tolerance);
    ASSERT_FALSE(spheres.empty()) << solid.name;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      EXPECT_LE(bvh.signed_distance(spheres[i].center), -spheres[i].radius + 1e-4) << solid.name;
      if (i > 0) {
        EXPECT_LE(spheres[i].radius, spheres[i - 1].radius) << "largest first";
      }
    }
    double farthest = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p = testing::any_surface_point(random, solid.mesh);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Sphere& s : spheres) nearest = std::min(nearest, (s.center - p).norm() - s.radius);
      farthest = std::max(farthest, nearest);
    }
    std::cout << solid.name << ": " << spheres.size() << " spheres, reach to within " << 1e3 * farthest
              << " mm\n";
    // The tolerance holds at samples of the surface; between those a little more is left out.
    EXPECT_LT(farthest, 2.0 * tolerance) << solid.name;
  }
}

// GraspIt!'s human hand is made of such links: neighbours reach into the open ends.
TEST(SphereCover, SpheresDoNotBulgeOutOfHoles) {
  const double radius = 0.01, height = 0.04, tolerance = 0.0007;
  TriangleMesh tube = testing::cylinder_mesh(radius, height);
  std::erase_if(tube.triangles, [&](const TriangleMesh::Triangle& t) {
    const double z[] = {tube.vertices[static_cast<std::size_t>(t[0])].z(),
                        tube.vertices[static_cast<std::size_t>(t[1])].z(),
                        tube.vertices[static_cast<std::size_t>(t[2])].z()};
    return z[0] == z[1] && z[1] == z[2];
  });
  const MeshBvh bvh(tube);
  const auto spheres = cover_with_inner_spheres(tube, bvh, tolerance);
  ASSERT_FALSE(spheres.empty());
  for (const Sphere& s : spheres) {
    EXPECT_GE(s.center.z() - s.radius, -1e-6);
    EXPECT_LE(s.center.z() + s.radius, height + 1e-6);
    EXPECT_LE(s.center.head<2>().norm() + s.radius, radius + 1e-6);
  }
  RandomStream random{3};
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p = testing::any_surface_point(random, tube);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres) nearest = std::min(nearest, (s.center - p).norm() - s.radius);
    EXPECT_LT(nearest, 1.27 * tolerance) << p.transpose();
  }
}

// Every point of the surface, at 0.3 mm, against all spheres; edges, thin walls and both orientations of a
// sheet inside the solid.
TEST(SphereCover, LeavesNoGapVsBruteForce) {
  std::vector<Solid> all = solids();
  TriangleMesh nested = testing::box_mesh({0.03, 0.03, 0.03});
  append(nested, testing::box_mesh({0.02, 0.02, 0.02}));  // a surface hidden inside
  all.push_back({"nested", nested});
  all.push_back({"plate", testing::box_mesh({0.015, 0.01, 0.0004})});
  for (const Solid& solid : all) {
    const MeshBvh bvh(solid.mesh);
    const std::size_t hidden_from = std::string(solid.name) == "nested" ? 12 : solid.mesh.triangles.size();
    for (const double tolerance : {0.0007, 0.0015}) {
      const auto spheres = cover_with_inner_spheres(solid.mesh, bvh, tolerance);
      for (const Sphere& s : spheres)
        EXPECT_LE(bvh.signed_distance(s.center), -s.radius + 1e-6) << solid.name;
      TriangleMesh visible = solid.mesh;
      visible.triangles.resize(hidden_from);
      double farthest = 0.0;
      const std::vector<Vec3> points = sample_surface(visible, 0.0003).points;
      for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 10007) {
        const Vec3& p = points[i];
        double nearest = std::numeric_limits<double>::infinity();
        for (const Sphere& s : spheres) nearest = std::min(nearest, (s.center - p).norm() - s.radius);
        farthest = std::max(farthest, nearest);
      }
      EXPECT_LT(farthest, 1.27 * tolerance) << solid.name << ", " << spheres.size() << " spheres";
    }
  }
}

TEST(SphereCover, OfNothingIsNothing) {
  EXPECT_TRUE(cover_with_inner_spheres({}, MeshBvh(), 0.001).empty());
  TriangleMesh needle;  // without area
  needle.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0.02, 0, 0}};
  needle.triangles = {{0, 1, 2}};
  EXPECT_TRUE(cover_with_inner_spheres(needle, MeshBvh(needle), 0.001).empty());
}

TEST(BoundingSphere, HoldsAllPointsAndIsNotMuchTooLarge) {
  RandomStream random{2};
  for (int k = 0; k < 50; ++k) {
    std::vector<Vec3> points;
    for (int i = 0; i < 200; ++i)
      points.push_back(Vec3(1, 2, 3) + random.uniform() * testing::random_direction(random));
    const Sphere ball = bounding_sphere(points);
    for (const Vec3& p : points) EXPECT_LE((p - ball.center).norm(), ball.radius * (1.0 + 1e-12));
    EXPECT_LT(ball.radius, 1.2);
  }
  EXPECT_EQ(bounding_sphere({Vec3(1, 2, 3)}).radius, 0.0);
}

TEST(SampleSurface, PointsLieOnTheSurfaceAndLeaveNoGap) {
  RandomStream random{3};
  const double spacing = 0.003;
  for (const Solid& solid : solids()) {
    const MeshBvh bvh(solid.mesh);
    const SurfaceSamples samples = sample_surface(solid.mesh, spacing);
    ASSERT_EQ(samples.points.size(), samples.normals.size());
    ASSERT_GE(samples.points.size(), solid.mesh.triangles.size());
    for (std::size_t i = 0; i < samples.points.size(); i += 7) {
      const ClosestPoint q = bvh.closest_point(samples.points[i]);
      EXPECT_LT(q.distance, 1e-9);
      EXPECT_NEAR(samples.normals[i].norm(), 1.0, 1e-9);
      EXPECT_LT(bvh.signed_distance(samples.points[i] - 1e-4 * samples.normals[i]), 0.0) << solid.name;
    }
    for (int k = 0; k < 500; ++k) {
      const Vec3 p = testing::any_surface_point(random, solid.mesh);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& q : samples.points) nearest = std::min(nearest, (q - p).norm());
      EXPECT_LT(nearest, spacing) << solid.name;
    }
    EXPECT_EQ(sample_surface(solid.mesh, spacing).points, samples.points);
  }
}

Eigen::Matrix2d curvature_at(const TriangleMesh& mesh, const Vec3& p, const Vec3& n, const Vec3& t1,
                             double radius = 0.0035) {
  return estimate_curvature(MeshBvh(mesh), p, n, t1, n.cross(t1), radius);
}

TEST(Curvature, OfABallIsOneOverItsRadiusInAllDirections) {
  RandomStream random{4};
  for (const double r : {0.008, 0.012, 0.03}) {
    const TriangleMesh mesh = testing::ball_mesh(r, 96);
    const MeshBvh bvh(mesh);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = bvh.closest_point(r * testing::random_direction(random)).point;
      const Vec3 n = p.normalized();
      const auto [t1, t2] = contact_tangents(n);
      const Eigen::Matrix2d K = estimate_curvature(bvh, p, n, t1, t2, 0.0035);
      EXPECT_LT((K * r - Eigen::Matrix2d::Identity()).norm(), 0.2) << "r " << r << "\n" << K * r;
    }
  }
}

TEST(Curvature, OfACylinderIsThatOfItsCircle) {
  const double r = 0.012;
  const TriangleMesh mesh = testing::cylinder_mesh(r, 0.06, 192);
  const Eigen::Matrix2d K = curvature_at(mesh, {r, 0.0, 0.03}, Vec3::UnitX(), Vec3::UnitY());
  EXPECT_NEAR(K(0, 0) * r, 1.0, 0.1);
  EXPECT_NEAR(K(0, 1) * r, 0.0, 0.02);
  EXPECT_NEAR(K(1, 1) * r, 0.0, 0.02);
  // In tangents that are turned by 45 degrees all entries are half as large.
  const Eigen::Matrix2d D =
      curvature_at(mesh, {r, 0.0, 0.03}, Vec3::UnitX(), Vec3(0.0, 1.0, 1.0).normalized());
  EXPECT_NEAR(D(0, 0) * r, 0.5, 0.05);
  EXPECT_NEAR(std::abs(D(0, 1)) * r, 0.5, 0.05);
  EXPECT_NEAR(D(1, 1) * r, 0.5, 0.05);
}

TEST(Curvature, OfAFlatFaceIsZero) {
  const TriangleMesh box = testing::box_mesh({0.03, 0.04, 0.05});
  EXPECT_LT(curvature_at(box, {0.015, 0.003, 0.001}, Vec3::UnitX(), Vec3::UnitY()).norm(), 1e-6);
}

// The inner side of a torus bends away along the tube and towards the outside along the ring.
TEST(Curvature, OfASaddleHasBothSigns) {
  const double ring = 0.04, tube = 0.015;
  const TriangleMesh mesh = testing::torus_mesh(ring, tube, 192);
  const Eigen::Matrix2d K = curvature_at(mesh, {ring - tube, 0.0, 0.0}, -Vec3::UnitX(), Vec3::UnitZ());
  EXPECT_NEAR(K(0, 0) * tube, 1.0, 0.1);
  EXPECT_NEAR(K(1, 1) * (ring - tube), -1.0, 0.1);
  EXPECT_NEAR(K(0, 1) * tube, 0.0, 0.02);
}

}  // namespace
}  // namespace eigengrasp
