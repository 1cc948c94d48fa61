// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/render/camera.hpp"
#include "eigengrasp/render/render_scene.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

using testing::ball_mesh;
using testing::box_mesh;

constexpr Color kBlue{0.2F, 0.4F, 0.9F, 1.0F};
constexpr Color kRed{0.9F, 0.1F, 0.1F, 1.0F};

/// Share of a white picture that something covers.
double coverage(const Image& image) {
  double covered = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) covered += image.pixel(x, y)[2] < 0.99F ? 1.0 : 0.0;
  return covered / (image.width * image.height);
}

RenderOptions size(int width, int height, int threads = 0) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.threads = threads;
  return options;
}

int count_red(const Image& image) {
  int red = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Color c = image.color(x, y);
      red += c.r > 1.4F * c.g && c.r > 1.4F * c.b ? 1 : 0;
    }
  return red;
}

TEST(Camera, FramesTheCornersOfABoxTightly) {
  Box box;
  box.add(Vec3(-0.1, -0.2, 0.3));
  box.add(Vec3(0.4, 0.1, 0.5));
  for (const Vec3& direction : view_candidates(Vec3::UnitZ())) {
    for (const double aspect : {0.5, 1.0, 2.0}) {
      const Camera camera = frame_camera(box, direction, Vec3::UnitZ(), 0.6, aspect);
      double reach = 0.0;
      for (int i = 0; i < 8; ++i) {
        const Vec3 corner((i & 1) != 0 ? box.max.x() : box.min.x(), (i & 2) != 0 ? box.max.y() : box.min.y(),
                          (i & 4) != 0 ? box.max.z() : box.min.z());
        const Vec3 uv = camera.project(corner);
        EXPECT_GT(uv.z(), 0.0);
        reach = std::max({reach, std::abs(uv.x()), std::abs(uv.y())});
      }
      EXPECT_NEAR(reach, 1.0, 1e-9);
    }
  }
}

TEST(Camera, ProjectsWhatItsRaysMeet) {
  const Camera camera = frame_camera(Box{Vec3(0, 0, 0), Vec3(1, 1, 1)}, Vec3(-1, -2, -0.5), Vec3::UnitZ());
  const Vec3 p = camera.position + 3.0 * camera.ray_direction(0.3, -0.7);
  EXPECT_NEAR((camera.project(p) - Vec3(0.3, -0.7, 3.0)).norm(), 0.0, 1e-12);
}

TEST(Camera, LooksAlongItsUpDirectionToo) {
  const Camera camera = frame_camera(Box{Vec3(0, 0, 0), Vec3(1, 1, 1)}, -Vec3::UnitZ(), Vec3::UnitZ());
  EXPECT_NEAR(camera.up.norm(), 1.0, 1e-12);
  EXPECT_NEAR(camera.up.dot(camera.forward), 0.0, 1e-12);
}

TEST(Camera, OffersDistinctViews) {
  const auto views = view_candidates(Vec3(0.0, 1.0, 0.0));
  EXPECT_EQ(views.size(), 17U);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_NEAR(views[i].norm(), 1.0, 1e-3);
    for (std::size_t j = 0; j < i; ++j) EXPECT_LT(views[i].dot(views[j]), 0.99);
  }
}

TEST(Render, ABallCoversPiQuartersOfItsFrame) {
  RenderScene scene;
  scene.add(ball_mesh(0.5), Pose::Identity(), kBlue);
  const Camera camera = frame_camera(scene.framed_points(), Vec3(-1, -1, -1), Vec3::UnitZ());
  const Image image = render(scene, camera, size(200, 200));
  EXPECT_NEAR(coverage(image), std::numbers::pi / 4.0, 0.01);
}

TEST(Render, ABoxFacingTheCameraFillsItsFrame) {
  RenderScene scene;
  scene.add(box_mesh({0.2, 0.2, 0.2}), Pose::Identity(), kBlue);
  const Camera camera = frame_camera(scene.framed_points(), -Vec3::UnitX(), Vec3::UnitZ());
  EXPECT_GT(coverage(render(scene, camera, size(100, 100))), 0.97);
}

TEST(Render, KeepsHueAndBackground) {
  RenderScene scene;
  scene.add(ball_mesh(0.5), Pose::Identity(), kBlue);
  RenderOptions options = size(64, 64);
  options.background = {0.5F, 0.6F, 0.7F, 1.0F};
  const Camera camera = frame_camera(scene.framed_points(), Vec3(-1, 0, 0), Vec3::UnitZ());
  const Image image = render(scene, camera, options);
  const Color middle = image.color(32, 32);
  EXPECT_GT(middle.b, middle.g);
  EXPECT_GT(middle.g, middle.r);
  EXPECT_NEAR(image.color(0, 0).r, 0.5F, 0.01F);
  EXPECT_NEAR(image.color(63, 63).b, 0.7F, 0.01F);
}

TEST(Render, LightComesFromTheUpperLeft) {
  RenderScene scene;
  scene.add(ball_mesh(0.5), Pose::Identity(), {0.8F, 0.8F, 0.8F, 1.0F});
  const Camera camera = frame_camera(scene.framed_points(), Vec3(-1, 0, 0), Vec3::UnitZ());
  const Image image = render(scene, camera, size(64, 64));
  EXPECT_GT(image.color(20, 20).g, image.color(44, 44).g + 0.1F);
}

TEST(Render, IsTheSameWithAnyNumberOfThreads) {
  RenderScene scene;
  scene.add(ball_mesh(0.5), Pose::Identity(), kBlue);
  scene.add(box_mesh({0.3, 0.3, 1.5}), Pose::Identity(), kRed);
  scene.add_sphere(Vec3(0.5, 0.0, 0.0), 0.1, kRed);
  scene.add_cone(Vec3(0.5, 0.0, 0.0), Vec3::UnitX(), 0.5, 0.3, {1.0F, 0.5F, 0.0F, 0.5F});
  scene.add_floor(-0.75, 5.0);
  const Camera camera = frame_camera(scene.framed_points(), Vec3(-1, -1, -1), Vec3::UnitZ());
  const Image one = render(scene, camera, size(90, 70, 1));
  const Image two = render(scene, camera, size(90, 70, 2));
  const Image five = render(scene, camera, size(90, 70, 5));
  EXPECT_EQ(one.rgba, two.rgba);
  EXPECT_EQ(one.rgba, five.rgba);
}

TEST(Render, AMarkerIsSeenInFrontAndFaintlyBehind) {
  RenderScene plain;
  plain.add(ball_mesh(0.5), Pose::Identity(), kBlue);
  const Camera camera = frame_camera(plain.framed_points(), Vec3(-1, 0, 0), Vec3::UnitZ());
  RenderScene front = plain;
  front.add_sphere(Vec3(0.5, 0, 0), 0.05, kRed);
  RenderScene behind = plain;
  behind.add_sphere(Vec3(-0.5, 0, 0), 0.05, kRed);
  const Image a = render(plain, camera, size(101, 101));
  const Image b = render(front, camera, size(101, 101));
  const Image c = render(behind, camera, size(101, 101));
  EXPECT_EQ(count_red(a), 0);
  EXPECT_NEAR(count_red(b), std::numbers::pi * 5 * 5, 40);
  EXPECT_GT(c.color(50, 50).r, a.color(50, 50).r + 0.05F);
  EXPECT_LT(c.color(50, 50).r, b.color(50, 50).r - 0.05F);
}

TEST(Render, AGhostLetsThroughWhatIsBehindIt) {
  RenderScene scene;
  scene.add(box_mesh({0.2, 1.0, 1.0}, {-1.0, 0.0, 0.0}), Pose::Identity(), kBlue);
  const Camera camera = frame_camera(scene.framed_points(), Vec3(-1, 0, 0), Vec3::UnitZ());
  const Image bare = render(scene, camera, size(41, 41));
  scene.add(box_mesh({0.2, 1.0, 1.0}), Pose::Identity(), {0.9F, 0.1F, 0.1F, 0.4F});
  const Image veiled = render(scene, camera, size(41, 41));
  EXPECT_GT(veiled.color(20, 20).r, bare.color(20, 20).r + 0.1F);
  EXPECT_GT(veiled.color(20, 20).b, veiled.color(20, 20).g);
}

TEST(Render, OfAGroupOfGhostsOnlyTheNearestCounts) {
  const Color pale{0.9F, 0.1F, 0.1F, 0.4F};
  const auto picture = [&](int boxes, bool grouped) {
    RenderScene scene;
    const int group = scene.new_group();
    for (int i = 0; i < boxes; ++i)
      scene.add(box_mesh({0.1, 1.0, 1.0}, {-0.3 * i, 0.0, 0.0}), Pose::Identity(), pale).group =
          grouped ? group : -1;
    const Camera camera =
        frame_camera(Box{Vec3(-0.05, -0.5, -0.5), Vec3(0.05, 0.5, 0.5)}, Vec3(-1, 0, 0), Vec3::UnitZ());
    return render(scene, camera, size(21, 21)).color(10, 10);
  };
  EXPECT_NEAR(picture(1, true).g, picture(3, true).g, 1e-3);
  EXPECT_LT(picture(3, false).g, picture(3, true).g - 0.05F);
}

TEST(Render, AFloorShowsAShadowOnly) {
  RenderScene scene;
  scene.add(ball_mesh(0.2), Pose::Identity(), kBlue);
  scene.add_floor(-0.2, 20.0);
  const Camera camera =
      frame_camera(Box{Vec3(-1, -1, -0.2), Vec3(1, 1, 0.2)}, Vec3(-1, 0, -1), Vec3::UnitZ());
  const Image image = render(scene, camera, size(100, 100));
  float darkest = 1.0F;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const Color c = image.color(x, y);
      if (c.b - c.r < 0.02F) darkest = std::min(darkest, c.r);
    }
  EXPECT_LT(darkest, 0.85F);
  EXPECT_GT(image.color(5, 50).r, 0.97F);
}

TEST(Render, EdgesOfABoxStaySharp) {
  RenderScene scene;
  scene.add(box_mesh({1, 1, 1}), Pose::Identity(), kBlue);
  const Camera camera = frame_camera(scene.framed_points(), Vec3(-1, -1, 0), Vec3::UnitZ());
  const Image image = render(scene, camera, size(100, 100));
  const float across = std::abs(image.color(46, 50).g - image.color(54, 50).g);
  const float along = std::abs(image.color(30, 50).g - image.color(46, 50).g);
  EXPECT_GT(across, 0.05F);
  EXPECT_LT(along, 0.5F * across);
}

TEST(Render, ACoarseBallHasNoFacets) {
  RenderScene scene;
  scene.add(ball_mesh(0.5, 12), Pose::Identity(), kBlue);
  const Camera camera = frame_camera(scene.framed_points(), Vec3(-1, 0, 0), Vec3::UnitZ());
  const Image image = render(scene, camera, size(100, 100));
  for (int x = 20; x < 80; ++x) EXPECT_NEAR(image.color(x, 50).g, image.color(x + 1, 50).g, 0.025F) << x;
}

TEST(Render, PicksAViewThatSeesThePoint) {
  RenderScene scene;
  scene.add(box_mesh({0.2, 0.2, 0.2}), Pose::Identity(), kBlue);
  for (const Vec3& side : {Vec3(0.1, 0, 0), Vec3(-0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(0, -0.1, 0)}) {
    const Vec3 view = pick_view(scene, std::vector<Vec3>{side}, Vec3::UnitZ());
    EXPECT_LT(view.dot(side), 0.0) << side.transpose();
  }
}

TEST(Render, RefusesSizesThatAreNotPictures) {
  EXPECT_THROW(render(RenderScene(), Camera(), size(0, 10)), Error);
  EXPECT_THROW(render(RenderScene(), Camera(), size(10, 100000)), Error);
}

TEST(Render, AnEmptySceneIsBackground) {
  const Image image = render(RenderScene(), Camera(), size(8, 8));
  EXPECT_EQ(coverage(image), 0.0);
}

}  // namespace
}  // namespace eigengrasp
