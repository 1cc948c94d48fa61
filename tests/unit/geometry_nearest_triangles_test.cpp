// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The nearest triangles of sixteen points at once against queries of one point at a time.
#include "geometry/nearest_triangles.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/variants.hpp"
#include "geometry/kernel/block_distances.hpp"
#include "geometry/kernel/point_looks.hpp"
#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using testing::any_point;
using testing::ball_mesh;
using testing::box_mesh;
using testing::torus_mesh;

/// Needles, points and triangles that lie twice among sound ones.
TriangleMesh with_bad_triangles() {
  TriangleMesh mesh = box_mesh({0.02, 0.03, 0.01});
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{0.02, 0, 0}, {0.03, 1e-9, 0}, {0.04, 0, 0}, {0, 0.03, 0.01}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first + 3, first + 3, first + 3});
  mesh.triangles.push_back(mesh.triangles.front());
  return mesh;
}

TEST(NearestTriangles, AreThoseOfOnePointAtATime) {
  RandomStream random{51};
  for (const TriangleMesh& mesh : {torus_mesh(0.03, 0.01, 24), ball_mesh(0.02, 30),
                                   box_mesh({0.05, 0.02, 0.08}), with_bad_triangles()}) {
    const MeshBvh bvh(mesh);
    for (int i = 0; i < 100; ++i) {
      const Vec3 about = any_point(random, bvh.box(), 0.01);
      const double spread = i % 2 == 0 ? 0.003 : 0.02;
      std::array<Vec3, detail::most_points> points;
      for (Vec3& p : points)
        p = about + spread * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const auto found = detail::find_nearest_triangles(bvh, about, points, 1.0);
      const auto near = detail::find_nearest_triangles(bvh, about, points, 0.004);
      for (std::size_t k = 0; k < points.size(); ++k) {
        const double expected = bvh.closest_point(points[k]).distance;
        ASSERT_GE(found[k], 0);
        const Vec3 q = closest_point_on_triangle(bvh.corners(found[k]), points[k]);
        EXPECT_NEAR((q - points[k]).norm(), expected, 1e-7 + 1e-5 * expected);
        if (std::abs(expected - 0.004) > 1e-6) {
          EXPECT_EQ(near[k] >= 0, expected < 0.004) << expected;
        }
      }
    }
  }
}

TEST(NearestTriangles, ThereAreNoneOfAnEmptySurface) {
  std::array<Vec3, detail::most_points> points;
  points.fill(Vec3::Zero());
  for (const int t : detail::find_nearest_triangles(MeshBvh(), Vec3::Zero(), points, 1.0)) EXPECT_EQ(t, -1);
}

void fill(RandomStream& random, float* values, std::size_t n, double reach) {
  for (std::size_t k = 0; k < n; ++k) values[k] = static_cast<float>(random.uniform(-reach, reach));
}

TEST(NearestTriangles, AllInstructionSetsGiveTheSameBits) {
  RandomStream random{52};
  for (int i = 0; i < 500; ++i) {
    point_kernel::Points points{};
    for (float* row : {points.x, points.y, points.z}) fill(random, row, kernel::n_lanes, 0.01);
    std::fill(std::begin(points.distance2), std::end(points.distance2), 5e-5f);
    float corners[9];
    float box[6];
    fill(random, corners, 9, 0.02);
    fill(random, box, 3, 0.02);
    for (int k = 0; k < 3; ++k) box[3 + k] = box[k] + static_cast<float>(random.uniform(0.0, 0.01));
    if (i % 10 == 0) std::copy(corners, corners + 3, corners + 3);
    point_kernel::Points expected = points;
    point_kernel::baseline_functions.meet_triangle(expected, corners, 7);
    for (const InstructionSet set : available_instruction_sets()) {
      if (set == InstructionSet::baseline) continue;
      const auto& functions = EIGENGRASP_VARIANT(point_kernel, set);
      point_kernel::Points found = points;
      EXPECT_EQ(functions.reach_box(found, box), point_kernel::baseline_functions.reach_box(points, box));
      functions.meet_triangle(found, corners, 7);
      EXPECT_EQ(std::memcmp(&found, &expected, sizeof found), 0) << i;
    }
  }
}

TEST(GridDistances, AllInstructionSetsGiveTheSameBits) {
  using namespace block_kernel;
  RandomStream random{53};
  constexpr int n_leaves = 40;
  for (int i = 0; i < 200; ++i) {
    std::vector<Triangle> triangles(2 * n_leaves);
    std::vector<float> corners(3 * 5 * n_leaves);
    std::vector<Leaf> leaves;
    std::vector<LeafBox> boxes(n_leaves);
    fill(random, corners.data(), corners.size(), 0.05);
    for (Triangle& t : triangles) fill(random, reinterpret_cast<float*>(&t), sizeof t / sizeof(float), 0.05);
    for (int k = 0; k < n_leaves; ++k) {
      leaves.push_back({5 * k, 5, 2 * k, 2, 1e-4f});
      fill(random, boxes[static_cast<std::size_t>(k)].min, 3, 0.05);
      for (int r = 0; r < 3; ++r)
        boxes[static_cast<std::size_t>(k)].max[r] = boxes[static_cast<std::size_t>(k)].min[r] + 0.01f;
    }
    const Surface surface{triangles.data(), reinterpret_cast<const float(*)[3]>(corners.data()),
                          leaves.data(), boxes.data(), 2e-6f};
    Ball ball{};
    fill(random, ball.center, 3, 0.05);
    ball.radius = 0.003f;
    ball.distance = 0.02f;
    ball.direction[i % 3] = 1.0f;
    ball.slack = 0.0003f;
    const int n = 1 + i % n_leaves;
    std::vector<std::int32_t> all;
    for (int k = 0; k < n; ++k) all.push_back(k);
    Nodes nodes{};
    for (float* row : {nodes.x, nodes.y, nodes.z}) fill(random, row, kernel::n_lanes, 0.05);
    struct alignas(64) Lanes {
      float values[kernel::n_lanes];
    };
    std::vector<Lanes> scratch(n_leaves);
    float* const lanes = scratch.front().values;
    std::vector<std::int32_t> kept(n_leaves + kernel::n_lanes);
    const int n_kept = baseline_functions.keep(surface, ball, all.data(), n, kept.data());
    Nodes expected = nodes;
    baseline_functions.measure(surface, all.data(), n, expected, lanes);
    for (const InstructionSet set : available_instruction_sets()) {
      if (set == InstructionSet::baseline) continue;
      const auto& functions = EIGENGRASP_VARIANT(block_kernel, set);
      std::vector<std::int32_t> found(n_leaves + kernel::n_lanes);
      ASSERT_EQ(functions.keep(surface, ball, all.data(), n, found.data()), n_kept);
      EXPECT_TRUE(std::equal(kept.begin(), kept.begin() + n_kept, found.begin()));
      Nodes measured = nodes;
      functions.measure(surface, all.data(), n, measured, lanes);
      EXPECT_EQ(std::memcmp(&measured, &expected, sizeof measured), 0) << i;
    }
  }
}

}  // namespace
}  // namespace eigengrasp
