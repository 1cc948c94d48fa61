// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Surfaces made of simulated views against the bodies that were seen.
#include "eigengrasp/scan/scan_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "eigengrasp/geometry/object_checks.hpp"
#include "eigengrasp/render/depth_camera.hpp"
#include "eigengrasp/scan/viewpoint.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

using eigengrasp::testing::ball_mesh;
using eigengrasp::testing::box_mesh;

PointCloud view_from(const TriangleMesh& mesh, const Vec3& position, double noise = 0.0005) {
  DepthCamera depth;
  depth.columns = depth.rows = 160;
  depth.noise = noise;
  depth.camera.position = position;
  depth.camera.forward = -position.normalized();
  depth.camera.up = depth.camera.forward.unitOrthogonal();
  depth.camera.fov = 2.0 * std::atan(0.6 * bounding_box(mesh).diagonal() / position.norm());
  return take_depth_view(mesh, depth, 7);
}

ScanSurface surface_of(const TriangleMesh& mesh, const Vec3& position, UnseenSpace unseen) {
  ScanOptions options;
  options.unseen = unseen;
  return make_scan_surface({view_from(mesh, position)}, options);
}

double volume_of(const TriangleMesh& mesh) {
  return inspect_mesh(mesh).volume;
}

/// Largest distance of the points seen from the surface.
double farthest_seen(const PointCloud& cloud, const TriangleMesh& mesh) {
  const MeshBvh bvh(mesh);
  double farthest = 0.0;
  for (const Vec3& p : cloud.points) farthest = std::max(farthest, bvh.closest_point(p).distance);
  return farthest;
}

const Vec3 kAbove(0.45, 0.2, 0.4);

TEST(ScanSurface, AMirroredBallIsTheBall) {
  const TriangleMesh ball = ball_mesh(0.04);
  const ScanSurface scan = surface_of(ball, kAbove, UnseenSpace::mirrored);
  ASSERT_TRUE(scan.mirror.has_value());
  const MeshReport report = inspect_mesh(scan.mesh);
  EXPECT_TRUE(report.watertight);
  EXPECT_EQ(report.components, 1);
  EXPECT_NEAR(report.volume / volume_of(ball), 1.0, 0.15);
  EXPECT_LT(bounding_box(scan.mesh).center().norm(), 0.010);
  EXPECT_NEAR(scan.seen_share, 0.5, 0.15);
}

TEST(ScanSurface, AMirroredBoxHasAboutItsSize) {
  const TriangleMesh box = box_mesh(Vec3(0.10, 0.06, 0.04));
  const ScanSurface scan = surface_of(box, kAbove, UnseenSpace::mirrored);
  EXPECT_TRUE(inspect_mesh(scan.mesh).watertight);
  EXPECT_NEAR(volume_of(scan.mesh) / volume_of(box), 1.0, 0.3);
}

TEST(ScanSurface, WhatIsSeenIsKeptHoweverTheRestIsTreated) {
  const TriangleMesh box = box_mesh(Vec3(0.10, 0.06, 0.04));
  const PointCloud cloud = view_from(box, kAbove);
  for (const UnseenSpace unseen : {UnseenSpace::mirrored, UnseenSpace::unknown, UnseenSpace::free}) {
    ScanOptions options;
    options.unseen = unseen;
    const ScanSurface scan = make_scan_surface({cloud}, options);
    EXPECT_TRUE(inspect_mesh(scan.mesh).watertight) << to_string(unseen);
    EXPECT_LT(farthest_seen(cloud, scan.mesh), 0.008) << to_string(unseen);
  }
}

TEST(ScanSurface, UnknownSpaceHoldsTheWholeBodyAndFreeSpaceNearlyNothing) {
  const TriangleMesh ball = ball_mesh(0.04);
  const double whole = volume_of(ball);
  EXPECT_GT(volume_of(surface_of(ball, kAbove, UnseenSpace::unknown).mesh), 0.8 * whole);
  const double wall = volume_of(surface_of(ball, kAbove, UnseenSpace::free).mesh);
  EXPECT_LT(wall, 0.35 * whole);
  EXPECT_GT(wall, 0.05 * whole);
}

TEST(ScanSurface, ViewsFromAllSidesGiveTheBodyWithoutAMirror) {
  const TriangleMesh box = box_mesh(Vec3(0.10, 0.06, 0.04));
  std::vector<PointCloud> views;
  for (const Vec3& from :
       {Vec3(0.5, 0.2, 0.3), Vec3(-0.4, 0.4, 0.3), Vec3(-0.1, -0.5, 0.3), Vec3(0.1, 0.1, -0.6)})
    views.push_back(view_from(box, from));
  const ScanSurface scan = make_scan_surface(views);
  EXPECT_EQ(scan.unseen, UnseenSpace::unknown);
  EXPECT_FALSE(scan.mirror.has_value());
  EXPECT_NEAR(volume_of(scan.mesh) / volume_of(box), 1.0, 0.12);
  EXPECT_GT(scan.seen_share, 0.9);
}

TEST(ScanSurface, TheTableGoesAndNothingReachesBelowIt) {
  TriangleMesh scene = box_mesh(Vec3(0.08, 0.08, 0.10), Vec3(0.0, 0.0, 0.05));
  append(scene, box_mesh(Vec3(0.5, 0.5, 0.01), Vec3(0.0, 0.0, -0.005)));
  ScanOptions options;
  options.remove_table = true;
  const ScanSurface scan = make_scan_surface({view_from(scene, Vec3(0.5, 0.3, 0.5))}, options);
  ASSERT_TRUE(scan.table.has_value());
  EXPECT_GT(scan.table->normal.z(), 0.999);
  EXPECT_GT(bounding_box(scan.mesh).min.z(), -0.003);
  EXPECT_LT(bounding_box(scan.mesh).size().head<2>().maxCoeff(), 0.13);
}

TEST(ScanSurface, TheSurfaceDoesNotDependOnThreads) {
  const PointCloud cloud = view_from(ball_mesh(0.03), kAbove);
  ScanOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const TriangleMesh a = make_scan_surface({cloud}, one).mesh, b = make_scan_surface({cloud}, two).mesh;
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.vertices, b.vertices);
}

TEST(Viewpoint, IsFoundWithinFortyDegrees) {
  for (const Vec3& from : {Vec3(0.5, 0.0, 0.3), Vec3(-0.3, 0.3, 0.4), Vec3(0.1, -0.5, 0.2)}) {
    const PointCloud cloud = view_from(box_mesh(Vec3(0.10, 0.06, 0.04)), from, 0.0);
    const Vec3 guess = estimate_viewpoint(cloud.points, point_spacing(cloud.points));
    EXPECT_GT(guess.normalized().dot(from.normalized()), std::cos(40.0 * std::acos(-1.0) / 180.0));
  }
}

/// What make_scan_surface says of a cloud that it refuses.
std::string refusal(std::vector<Vec3> points) {
  PointCloud cloud;
  cloud.points = std::move(points);
  try {
    make_scan_surface({cloud});
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(ScanSurface, RefusesWhatIsNoObject) {
  EXPECT_NE(refusal({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}).find("3 points"), std::string::npos);
  std::vector<Vec3> plane, line, large;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) plane.emplace_back(0.005 * i, 0.005 * j, 0.0);
  for (int i = 0; i < 100; ++i) line.emplace_back(0.001 * i, 0.0, 0.0);
  for (Vec3 p : view_from(ball_mesh(0.04), kAbove).points) large.emplace_back(1000.0 * p);
  EXPECT_NE(refusal(plane).find("in a plane"), std::string::npos);
  EXPECT_NE(refusal(line).find("on a line"), std::string::npos);
  EXPECT_NE(refusal(large).find("--units mm"), std::string::npos);
  EXPECT_NE(refusal(std::vector<Vec3>(100, Vec3::Ones())).find("one and the same"), std::string::npos);
}

}  // namespace
}  // namespace eigengrasp
