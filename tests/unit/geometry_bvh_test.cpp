// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Queries of the bounding-volume hierarchy against loops over all triangles and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using testing::any_point;
using testing::any_pose;
using testing::ball_mesh;
using testing::box_mesh;
using testing::random_direction;
using testing::torus_mesh;

TriangleCorners corners_of(const TriangleMesh& mesh, std::size_t t) {
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

std::vector<TriangleMesh> sample_meshes() {
  TriangleMesh soup = torus_mesh(0.03, 0.01, 16);
  append(soup, box_mesh({0.01, 0.05, 0.02}, {0.02, 0.01, 0.0}));
  soup.triangles.push_back({0, 0, 0});
  soup.triangles.push_back({1, 5, 1});
  return {ball_mesh(0.04, 12), torus_mesh(0.04, 0.012, 32), box_mesh({0.05, 0.02, 0.08}), soup};
}

TEST(MeshBvh, ClosestPointVsBruteForce) {
  RandomStream random{1};
  for (const TriangleMesh& mesh : sample_meshes()) {
    const MeshBvh bvh(mesh);
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = any_point(random, bvh.box(), 0.03);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        nearest = std::min(nearest, (closest_point_on_triangle(corners_of(mesh, t), p) - p).norm());
      const ClosestPoint q = bvh.closest_point(p);
      EXPECT_NEAR(q.distance, nearest, 1e-12);
      EXPECT_NEAR((q.point - p).norm(), nearest, 1e-12);
      ASSERT_GE(q.triangle, 0);
      EXPECT_LT((closest_point_on_triangle(bvh.corners(q.triangle), q.point) - q.point).norm(), 1e-12);
      EXPECT_EQ(bvh.closest_point(p, 0.999 * nearest).triangle, -1);
      EXPECT_NEAR(bvh.closest_point(p, 1.001 * nearest + 1e-9).distance, nearest, 1e-12);
    }
  }
}

TEST(MeshBvh, WindingNumberOfABallIsOneInsideAndZeroOutside) {
  RandomStream random{2};
  const MeshBvh bvh(ball_mesh(0.05, 40));
  for (int i = 0; i < 500; ++i) {
    const double r = random.uniform(0.0, 0.12);
    if (std::abs(r - 0.05) < 0.001) continue;
    const Vec3 p = r * random_direction(random);
    EXPECT_NEAR(bvh.winding_number(p), r < 0.05 ? 1.0 : 0.0, 0.05) << "at radius " << r;
    EXPECT_EQ(bvh.contains(p), r < 0.05);
    EXPECT_EQ(bvh.signed_distance(p) < 0.0, r < 0.05);
    EXPECT_NEAR(bvh.signed_distance(p), r - 0.05, 1e-4);
  }
}

// A ball without its cap of polar angle a has, seen from its middle, the solid angle of the rest:
// (1 + cos a) / 2 of all. From the point opposite on the axis (far away) it goes to 0.
TEST(MeshBvh, WindingNumberOfABallWithAHole) {
  for (const double keep : {0.5, 0.75, 0.9}) {
    const TriangleMesh ball = ball_mesh(0.05, 40);
    TriangleMesh open;
    open.vertices = ball.vertices;
    const double z_cut = 0.05 * std::cos(std::numbers::pi * keep);
    for (const auto& t : ball.triangles) {
      double middle = 0.0;
      for (const auto v : t) middle += ball.vertices[static_cast<std::size_t>(v)].z() / 3.0;
      if (middle > z_cut) open.triangles.push_back(t);
    }
    const MeshBvh bvh(open);
    const double share = 0.5 * (1.0 - std::cos(std::numbers::pi * keep));
    EXPECT_NEAR(bvh.winding_number(Vec3::Zero()), share, 0.03) << keep;
    EXPECT_NEAR(bvh.winding_number({0.0, 0.0, 2.0}), 0.0, 0.01) << keep;
  }
}

TEST(MeshBvh, EmptyMeshHasNoNearestPoint) {
  const MeshBvh bvh;
  EXPECT_TRUE(bvh.empty());
  EXPECT_EQ(bvh.closest_point(Vec3::Zero()).triangle, -1);
}

struct Pair {
  double distance = std::numeric_limits<double>::infinity();
  std::map<std::pair<int, int>, double> near;
};

Pair brute_force(const TriangleMesh& a, const TriangleMesh& b, const Pose& X_AB, double bound) {
  Pair result;
  const TriangleMesh posed = testing::moved(b, X_AB);
  for (std::size_t s = 0; s < a.triangles.size(); ++s)
    for (std::size_t t = 0; t < posed.triangles.size(); ++t) {
      Vec3 p, q;
      const double d = closest_points_of_triangles(corners_of(a, s), corners_of(posed, t), p, q);
      result.distance = std::min(result.distance, d);
      if (d <= bound) result.near[{static_cast<int>(s), static_cast<int>(t)}] = d;
    }
  return result;
}

TEST(MeshBvh, PairQueriesVsBruteForce) {
  RandomStream random{3};
  const TriangleMesh a = torus_mesh(0.03, 0.01, 16);
  const TriangleMesh b = box_mesh({0.01, 0.05, 0.03});
  const MeshBvh bvh_a(a), bvh_b(b);
  PairHint hint;
  int apart = 0, crossing = 0, pairs = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X_AB = any_pose(random, 0.06);
    const double bound = 0.004;
    const Pair expected = brute_force(a, b, X_AB, bound);
    const ClosestPair found = closest_pair(bvh_a, bvh_b, X_AB);
    EXPECT_NEAR(found.distance, expected.distance, 1e-12);
    if (found.distance > 0.0) {
      EXPECT_NEAR((found.p_a - found.p_b).norm(), found.distance, 1e-12);
    }
    EXPECT_EQ(closest_pair(bvh_a, bvh_b, X_AB, std::numeric_limits<double>::infinity(), &hint).distance,
              found.distance);
    const ClosestPair bounded = closest_pair(bvh_a, bvh_b, X_AB, bound, &hint);
    if (expected.distance < bound) {
      EXPECT_EQ(bounded.distance, found.distance);
    }
    if (expected.distance > bound) {
      EXPECT_EQ(bounded.triangle_a, -1);
    }
    EXPECT_EQ(intersects(bvh_a, bvh_b, X_AB), expected.distance == 0.0);

    std::map<std::pair<int, int>, double> near;
    for_each_pair_within(bvh_a, bvh_b, X_AB, bound, [&](const ClosestPair& p) {
      const bool fresh = near.emplace(std::pair(p.triangle_a, p.triangle_b), p.distance).second;
      EXPECT_TRUE(fresh);
      EXPECT_LE(p.distance, bound);
    });
    ASSERT_EQ(near.size(), expected.near.size());
    for (const auto& [key, distance] : expected.near) {
      ASSERT_TRUE(near.contains(key));
      EXPECT_NEAR(near[key], distance, 1e-12);
    }
    apart += expected.distance > 0.0;
    crossing += expected.distance == 0.0;
    pairs += static_cast<int>(near.size());
  }
  EXPECT_GT(apart, 40);
  EXPECT_GT(crossing, 40);
  EXPECT_GT(pairs, 1000);
}

TEST(MeshBvh, AnyHintGivesTheSameDistance) {
  RandomStream random{4};
  const MeshBvh a(ball_mesh(0.03, 10)), b(torus_mesh(0.03, 0.01, 16));
  for (int i = 0; i < 200; ++i) {
    const Pose X_AB = any_pose(random, 0.1);
    const double free = closest_pair(a, b, X_AB).distance;
    PairHint hint{static_cast<int>(random.uniform(0, a.triangle_count())),
                  static_cast<int>(random.uniform(0, b.triangle_count()))};
    const ClosestPair hinted = closest_pair(a, b, X_AB, std::numeric_limits<double>::infinity(), &hint);
    EXPECT_EQ(hinted.distance, free);
    if (free > 0.0) {
      EXPECT_EQ(hint.triangle_a, hinted.triangle_a);
    }
  }
}

TEST(MeshBvh, ABallInsideABoxDoesNotCrossIt) {
  const MeshBvh box(box_mesh({0.1, 0.1, 0.1})), ball(ball_mesh(0.03, 12));
  EXPECT_FALSE(intersects(box, ball, Pose::Identity()));
  EXPECT_NEAR(closest_pair(box, ball, Pose::Identity()).distance, 0.02, 1e-9);
}

}  // namespace
}  // namespace eigengrasp
