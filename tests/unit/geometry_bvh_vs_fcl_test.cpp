// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Distances and crossings of two meshes against FCL, the Flexible Collision Library.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <memory>

#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;

struct Solid {
  const char* name;
  MeshBvh ours;
  std::shared_ptr<FclMesh> theirs;
};

Solid make_solid(const char* name, const TriangleMesh& mesh) {
  auto theirs = std::make_shared<FclMesh>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles)
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  theirs->beginModel();
  theirs->addSubModel(mesh.vertices, triangles);
  theirs->endModel();
  return {name, MeshBvh(mesh), theirs};
}

bool fcl_collides(const Solid& a, const Solid& b, const Pose& X_AB) {
  fcl::CollisionResultd result;
  return fcl::collide(a.theirs.get(), Pose::Identity(), b.theirs.get(), X_AB, fcl::CollisionRequestd(),
                      result) > 0;
}

double fcl_distance(const Solid& a, const Solid& b, const Pose& X_AB) {
  fcl::DistanceResultd result;
  return fcl::distance(a.theirs.get(), Pose::Identity(), b.theirs.get(), X_AB, fcl::DistanceRequestd(),
                       result);
}

std::vector<Solid> solids() {
  std::vector<Solid> result;
  result.push_back(make_solid("ball", testing::ball_mesh(0.03, 16)));
  result.push_back(make_solid("torus", testing::torus_mesh(0.035, 0.01, 24)));
  result.push_back(make_solid("box", testing::box_mesh({0.02, 0.05, 0.08})));
  result.push_back(make_solid("capsule", testing::capsule_mesh(0.012, 0.03)));
  return result;
}

TEST(MeshBvhVsFcl, RandomPoses) {
  RandomStream random{1};
  const auto all = solids();
  int apart = 0, crossing = 0;
  for (const Solid& a : all)
    for (const Solid& b : all)
      for (int i = 0; i < 60; ++i) {
        const Pose X_AB = testing::any_pose(random, 0.08);
        const bool crosses = intersects(a.ours, b.ours, X_AB);
        EXPECT_EQ(crosses, fcl_collides(a, b, X_AB)) << a.name << " " << b.name << " " << i;
        const double distance = closest_pair(a.ours, b.ours, X_AB).distance;
        if (crosses) {
          EXPECT_EQ(distance, 0.0);
          ++crossing;
        } else {
          EXPECT_NEAR(distance, fcl_distance(a, b, X_AB), 1e-9) << a.name << " " << b.name << " " << i;
          ++apart;
        }
      }
  EXPECT_GT(apart, 200);
  EXPECT_GT(crossing, 200);
}

// The second surface is pushed along the shortest connection until little is left between the two, or they
// overlap by as much.
TEST(MeshBvhVsFcl, NearlyTouching) {
  RandomStream random{2};
  const auto all = solids();
  int tested = 0;
  for (const Solid& a : all)
    for (const Solid& b : all)
      for (int i = 0; i < 20; ++i) {
        Pose X_AB = testing::any_pose(random, 0.02);
        X_AB.translation() += 0.12 * testing::random_direction(random);
        const ClosestPair pair = closest_pair(a.ours, b.ours, X_AB);
        if (pair.distance <= 0.0) continue;
        const Vec3 direction = (pair.p_a - pair.p_b) / pair.distance;
        for (const double gap : {1e-3, 1e-4, 1e-6, -1e-6, -1e-4}) {
          Pose X = X_AB;
          X.translation() += (pair.distance - gap) * direction;
          EXPECT_EQ(intersects(a.ours, b.ours, X), gap < 0.0) << a.name << " " << b.name << " " << gap;
          EXPECT_EQ(fcl_collides(a, b, X), gap < 0.0) << a.name << " " << b.name << " " << gap;
          const double distance = closest_pair(a.ours, b.ours, X, 0.01).distance;
          EXPECT_NEAR(distance, std::max(gap, 0.0), 1e-9) << a.name << " " << b.name << " " << gap;
          if (gap > 0.0) {
            EXPECT_NEAR(distance, fcl_distance(a, b, X), 1e-9);
          }
          ++tested;
        }
      }
  EXPECT_GT(tested, 1000);
}

}  // namespace
}  // namespace eigengrasp
