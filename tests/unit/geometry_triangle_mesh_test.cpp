// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include "unit/geometry_shapes.hpp"

namespace eigengrasp::testing {
namespace {

TEST(TriangleMesh, AreaNormalIsTwiceTheAreaOutwards) {
  const TriangleMesh box = box_shape(Vec3(2, 3, 5));
  expect_near(area_normal(box, 0), Vec3(0, 0, -6), 0.0);
  expect_near(area_normal(box, 2), Vec3(0, 0, 6), 0.0);
  EXPECT_DOUBLE_EQ(surface_area(box), 2 * (6 + 10 + 15));
}

TEST(TriangleMesh, BoxHoldsAllVertices) {
  EXPECT_TRUE(Box{}.empty());
  EXPECT_EQ(Box{}.diagonal(), 0.0);
  const Box box = bounding_box(box_shape(Vec3(2, 3, 6)));
  expect_near(box.min, Vec3::Zero(), 0.0);
  expect_near(box.max, Vec3(2, 3, 6), 0.0);
  EXPECT_DOUBLE_EQ(box.diagonal(), 7.0);
}

TEST(TriangleMesh, TransformScalesAfterTheMotion) {
  TriangleMesh mesh = box_shape();
  const Pose X = make_pose(Eigen::Quaterniond(1, 0, 0, 1), Vec3(1, 2, 3));  // a quarter turn about z
  transform(mesh, X, 10.0);
  expect_near(mesh.vertices[1], Vec3(10, 30, 30), 1e-13);
}

TEST(TriangleMesh, AppendShiftsTheIndices) {
  TriangleMesh mesh = box_shape();
  append(mesh, box_shape());
  EXPECT_EQ(mesh.vertices.size(), 16u);
  EXPECT_EQ(mesh.triangles[12][0], 8);
}

TEST(Weld, MakesOneVertexOfEqualOnes) {
  TriangleMesh mesh = soup_of(box_shape());
  EXPECT_EQ(mesh.vertices.size(), 36u);
  weld(mesh, 0.0);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_DOUBLE_EQ(surface_area(mesh), 6.0);
}

TEST(Weld, KnowsOneZero) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  weld(mesh, 0.0);
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

TEST(Weld, ExactKeepsNeighboursApart) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1e-15, 0, 0}, {0, 1e-15, 0}};
  mesh.triangles = {{0, 1, 2}};
  weld(mesh, 0.0);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(Weld, MergesWithinTheToleranceAcrossCells) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    TriangleMesh mesh = soup_of(sphere_shape(2));
    for (Vec3& v : mesh.vertices)
      v += 2e-4 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    weld(mesh, 1e-3);
    EXPECT_EQ(mesh.vertices.size(), sphere_shape(2).vertices.size());
    EXPECT_EQ(mesh.triangles.size(), sphere_shape(2).triangles.size());
  }
}

TEST(Weld, DropsCollapsedTrianglesAndUnusedVertices) {
  TriangleMesh mesh = box_shape();
  mesh.vertices.emplace_back(9, 9, 9);
  mesh.vertices.emplace_back(0, 0, 1e-6);
  mesh.triangles.push_back({0, 9, 1});
  weld(mesh, 1e-5);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
}

TEST(Weld, IsIdempotent) {
  TriangleMesh once = soup_of(sphere_shape(3));
  weld(once, 0.0);
  TriangleMesh twice = once;
  weld(twice, 0.0);
  EXPECT_EQ(once.vertices.size(), twice.vertices.size());
  EXPECT_EQ(once.triangles, twice.triangles);
}

}  // namespace
}  // namespace eigengrasp::testing
