// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Against closed forms and laws of integrals.
#include "eigengrasp/geometry/mass_properties.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/object_checks.hpp"
#include "eigengrasp/geometry/object_model.hpp"
#include "unit/geometry_shapes.hpp"

namespace eigengrasp::testing {
namespace {

TEST(MassProperties, BoxVsClosedForm) {
  const Vec3 size(0.2, 0.3, 0.5);
  const MeshReport report = inspect_mesh(box_shape(size));
  EXPECT_TRUE(report.watertight);
  EXPECT_TRUE(report.consistent_orientation);
  EXPECT_TRUE(report.solid());
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.degenerate_triangles, 0);
  EXPECT_NEAR(report.volume, 0.03, 1e-15);
  EXPECT_NEAR(report.area, 2 * (0.06 + 0.10 + 0.15), 1e-14);
  expect_near(report.volume_center, 0.5 * size, 1e-15);
  expect_near(report.surface_center, 0.5 * size, 1e-15);
  expect_near(report.box.size(), size, 1e-15);
}

TEST(MassProperties, TetrahedronVsClosedForm) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 1, 1}, {3, 1, 1}, {1, 4, 1}, {1, 1, 6}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_NEAR(report.volume, 2.0 * 3.0 * 5.0 / 6.0, 1e-13);
  expect_near(report.volume_center, Vec3(1.5, 1.75, 2.25), 1e-13);
  const double slanted = 0.5 * std::sqrt(15 * 15 + 10 * 10 + 6 * 6);
  EXPECT_NEAR(report.area, 3 + 5 + 7.5 + slanted, 1e-13);
  const Vec3 moment =
      3 * Vec3(5, 6, 3) / 3 + 5 * Vec3(5, 3, 8) / 3 + 7.5 * Vec3(3, 6, 8) / 3 + slanted * Vec3(5, 6, 8) / 3;
  expect_near(report.surface_center, moment / report.area, 1e-13);
}

TEST(MassProperties, SphereConvergesWithTheSquareOfTheEdge) {
  double last = 0.0;
  for (int levels = 2; levels <= 5; ++levels) {
    const double missing = 4.0 / 3.0 * std::numbers::pi - inspect_mesh(sphere_shape(levels)).volume;
    EXPECT_GT(missing, 0.0);
    EXPECT_TRUE(levels == 2 || std::abs(last / missing - 4.0) < 0.3) << last / missing;
    last = missing;
  }
  EXPECT_LT(last, 0.01);
}

TEST(MassProperties, RigidMotionMovesTheCentresAndKeepsTheRest) {
  TriangleMesh mesh = sphere_shape(1);
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(Vec3(1, 2, 3)) + Vec3(0.1 * v.x() * v.y(), 0, v.x());
  const MeshReport still = inspect_mesh(mesh);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const Pose X = random_pose(random, 10.0);
    TriangleMesh moved = mesh;
    transform(moved, X);
    const MeshReport report = inspect_mesh(moved);
    EXPECT_NEAR(report.volume, still.volume, 1e-11);
    EXPECT_NEAR(report.area, still.area, 1e-11);
    expect_near(report.volume_center, X * still.volume_center, 1e-11);
    expect_near(report.surface_center, X * still.surface_center, 1e-11);
    EXPECT_TRUE(report.watertight);
  }
}

TEST(MassProperties, AddOverComponents) {
  TriangleMesh mesh = box_shape(Vec3(1, 1, 2));
  TriangleMesh other = sphere_shape(2);
  transform(other, make_pose(Eigen::Quaterniond::Identity(), Vec3(5, 0, 0)));
  const MeshReport a = inspect_mesh(mesh), b = inspect_mesh(other);
  append(mesh, other);
  const MeshReport both = inspect_mesh(mesh);
  EXPECT_EQ(both.components, 2);
  EXPECT_TRUE(both.watertight);
  EXPECT_NEAR(both.volume, a.volume + b.volume, 1e-12);
  EXPECT_NEAR(both.area, a.area + b.area, 1e-12);
  expect_near(both.volume_center, (a.volume * a.volume_center + b.volume * b.volume_center) / both.volume,
              1e-12);
}

TEST(MassProperties, BoxesThatTouchInAnEdgeAreClosed) {
  TriangleMesh mesh = box_shape();
  TriangleMesh other = box_shape();
  transform(other, make_pose(Eigen::Quaterniond::Identity(), Vec3(1, 1, 0)));
  append(mesh, other);
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.non_manifold_edges, 1);
  EXPECT_TRUE(report.solid());
  EXPECT_NEAR(report.volume, 2.0, 1e-14);
  expect_near(report.volume_center, Vec3(1, 1, 0.5), 1e-14);
}

TEST(MassProperties, SoupIsWeldedFirst) {
  const MeshReport report = inspect_mesh(soup_of(box_shape()));
  EXPECT_TRUE(report.watertight);
  EXPECT_EQ(report.components, 1);
  EXPECT_NEAR(report.volume, 1.0, 1e-14);
}

TEST(MassProperties, InsideOutHasNegativeVolumeAndIsNoSolid) {
  TriangleMesh mesh = box_shape();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_TRUE(report.watertight);
  EXPECT_TRUE(report.consistent_orientation);
  EXPECT_NEAR(report.volume, -1.0, 1e-14);
  EXPECT_FALSE(report.solid());
}

TEST(MassProperties, CountsOpenTurnedAndCrowdedEdges) {
  TriangleMesh open = box_shape();
  open.triangles.pop_back();
  EXPECT_EQ(inspect_mesh(open).boundary_edges, 3);
  EXPECT_FALSE(inspect_mesh(open).watertight);

  TriangleMesh turned = box_shape();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_FALSE(inspect_mesh(turned).consistent_orientation);
  EXPECT_FALSE(inspect_mesh(turned).watertight);

  TriangleMesh fin = box_shape();
  fin.vertices.emplace_back(-1, -1, 0.5);
  fin.triangles.push_back({0, 4, 8});
  EXPECT_EQ(inspect_mesh(fin).non_manifold_edges, 1);
  EXPECT_EQ(inspect_mesh(fin).boundary_edges, 2);
}

TEST(MassProperties, DegenerateAndFlatMeshesGiveNoNonsense) {
  TriangleMesh sliver;
  sliver.vertices = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}};
  sliver.triangles = {{0, 1, 2}};
  const MeshReport line = inspect_mesh(sliver);
  EXPECT_EQ(line.degenerate_triangles, 1);
  EXPECT_TRUE(line.center_of_mass().allFinite());

  TriangleMesh sheet;  // both sides of one triangle: closed, without volume
  sheet.vertices = {{0.1, 0.2, 0.7}, {1.3, 0, 0.1}, {0, 1.7, 0.3}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  const MeshReport flat = inspect_mesh(sheet);
  EXPECT_TRUE(flat.watertight);
  EXPECT_EQ(flat.volume, 0.0);
  EXPECT_FALSE(flat.solid());
  expect_near(flat.center_of_mass(), (sheet.vertices[0] + sheet.vertices[1] + sheet.vertices[2]) / 3, 1e-14);
}

TEST(ObjectModel, TakesTheCentreOfTheSolidOrOfTheSurfaceOrTheGivenOne) {
  const ObjectModel solid = make_object("box", box_shape(Vec3(2, 2, 2)));
  EXPECT_TRUE(solid.watertight);
  EXPECT_EQ(solid.name, "box");
  expect_near(solid.center_of_mass, Vec3(1, 1, 1), 1e-14);
  EXPECT_NEAR(solid.max_radius, std::sqrt(3.0), 1e-14);
  EXPECT_FALSE(solid.bvh.empty());

  TriangleMesh open = box_shape(Vec3(2, 2, 2));
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);  // without its top
  const ObjectModel surface = make_object("tray", open);
  EXPECT_FALSE(surface.watertight);
  expect_near(surface.center_of_mass, Vec3(1, 1, 0.8), 1e-14);

  const Vec3 given(0, 0, 0);
  const ObjectModel loaded = make_object("loaded", box_shape(Vec3(2, 2, 2)), &given);
  expect_near(loaded.center_of_mass, given, 0.0);
  EXPECT_NEAR(loaded.max_radius, std::sqrt(12.0), 1e-14);
}

TEST(ObjectModel, IgnoresVerticesOfNoTriangle) {
  TriangleMesh mesh = box_shape();
  mesh.vertices.emplace_back(100, 0, 0);
  EXPECT_NEAR(make_object("box", mesh).max_radius, std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(inspect_mesh(mesh).box.size().x(), 1.0, 0.0);
}

std::vector<std::string> warnings_of(double size) {
  return size_warnings(inspect_mesh(box_shape(size * Vec3(1, 0.5, 0.5))), 0.2);
}

TEST(SizeWarnings, NameTheUnitThatFits) {
  EXPECT_TRUE(warnings_of(0.14).empty());
  ASSERT_EQ(warnings_of(140).size(), 1u);
  EXPECT_EQ(warnings_of(140)[0], "the object is 140 m wide; did you mean --units mm (14 cm)?");
  EXPECT_EQ(warnings_of(14)[0],
            "the object is 14 m wide; did you mean --units mm (1.4 cm) or --units cm (14 cm) or --units in "
            "(35.6 cm)?");
  EXPECT_EQ(warnings_of(1e5)[0],
            "the object is 1e+05 m wide, much more than the hand; check its units and scale");
  EXPECT_EQ(warnings_of(0.00014)[0],
            "the object is 0.14 mm wide; did you mean --units m instead of mm (14 cm) or "
            "--units m instead of cm (1.4 cm)?");
  EXPECT_EQ(warnings_of(1e-7)[0],
            "the object is 0.0001 mm wide, much less than the hand; check its units and scale");
}

TEST(SizeWarnings, TellWhyTheCentreOfMassIsTheSurfaces) {
  TriangleMesh open = box_shape(Vec3(0.1, 0.1, 0.1));
  open.triangles.pop_back();
  EXPECT_NE(size_warnings(inspect_mesh(open), 0.2).at(0).find("not watertight (3 open edges"),
            std::string::npos);
  TriangleMesh turned = box_shape(Vec3(0.1, 0.1, 0.1));
  for (auto& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_NE(size_warnings(inspect_mesh(turned), 0.2).at(0).find("inside out"), std::string::npos);
}

}  // namespace
}  // namespace eigengrasp::testing
