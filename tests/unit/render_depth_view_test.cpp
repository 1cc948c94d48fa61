// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The surface that a camera sees, against balls of known size.
#include <gtest/gtest.h>

#include <numbers>

#include "eigengrasp/render/depth_camera.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

constexpr double radius = 0.05;

DepthCamera camera_at(double distance) {
  DepthCamera camera;
  camera.columns = camera.rows = 200;
  camera.camera.position = {0.0, 0.0, distance};
  camera.camera.forward = -Vec3::UnitZ();
  camera.camera.up = Vec3::UnitX();
  camera.camera.fov = 2.0 * std::atan(1.2 * radius / distance);
  return camera;
}

Vec3 area_vector(const TriangleMesh& mesh, std::size_t t) {
  return 0.5 * (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
}

TEST(SurfaceView, holds_the_cap_of_a_ball_that_faces_the_camera) {
  const double distance = 1.0;
  DepthCamera camera = camera_at(distance);
  camera.least_cosine = 0.5;  // else single pixels at the rim hold much of the area
  const std::vector<TriangleMesh> views = take_surface_views(testing::ball_mesh(radius, 64), {&camera, 1});
  ASSERT_EQ(views.size(), 1u);
  double area = 0.0;
  for (std::size_t t = 0; t < views[0].triangles.size(); ++t) {
    const Vec3 a = area_vector(views[0], t);
    area += a.norm();
    EXPECT_GT(a.dot(camera.camera.position - views[0].corner(t, 0)), 0.0) << "faces away";
  }
  // Of the cap whose rays meet the surface at the least cosine all is there but a rim, in which diagonal
  // neighbours differ by more than the least cosine lets neighbours differ.
  const auto cap = [&](double cosine) {
    const double polar = (cosine + radius / distance) / (1.0 + cosine * radius / distance);
    return 2.0 * std::numbers::pi * radius * radius * (1.0 - polar);
  };
  const double slope = std::sqrt(1.0 / (camera.least_cosine * camera.least_cosine) - 1.0) / std::sqrt(2.0);
  EXPECT_LT(area, cap(camera.least_cosine));
  EXPECT_GT(area, 0.97 * cap(1.0 / std::sqrt(1.0 + slope * slope)));
  for (const Vec3& p : views[0].vertices) EXPECT_NEAR(p.norm(), radius, 0.002 * radius);
}

TEST(SurfaceView, does_not_join_what_lies_far_behind) {
  TriangleMesh balls = testing::ball_mesh(radius, 48);
  TriangleMesh behind = balls;
  transform(behind, Pose(Eigen::Translation3d(0.8 * radius, 0.0, -6.0 * radius)), 1.0);
  const int first = static_cast<int>(balls.vertices.size());
  balls.vertices.insert(balls.vertices.end(), behind.vertices.begin(), behind.vertices.end());
  for (TriangleMesh::Triangle t : behind.triangles) {
    for (std::int32_t& v : t) v += first;
    balls.triangles.push_back(t);
  }
  const DepthCamera camera = camera_at(1.0);
  const TriangleMesh view = take_surface_views(balls, {&camera, 1}).front();
  int in_front = 0, beyond = 0;
  for (std::size_t t = 0; t < view.triangles.size(); ++t) {
    const auto is_behind = [&](int k) { return view.corner(t, k).z() < -3.0 * radius; };
    EXPECT_TRUE(is_behind(0) == is_behind(1) && is_behind(1) == is_behind(2));
    ++(is_behind(0) ? beyond : in_front);
  }
  EXPECT_GT(in_front, 10000);
  EXPECT_GT(beyond, 1000);
}

TEST(SurfaceView, is_empty_where_nothing_is_seen) {
  DepthCamera camera = camera_at(1.0);
  camera.camera.forward = Vec3::UnitZ();
  EXPECT_TRUE(take_surface_views(testing::ball_mesh(radius, 16), {&camera, 1}).front().triangles.empty());
}

}  // namespace
}  // namespace eigengrasp
