// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Balls about a surface: that they hold it, and their free times against exact distances along the motion.
#include "eigengrasp/geometry/ball_cover.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/variants.hpp"
#include "geometry/kernel/ball_looks.hpp"
#include "support/gripper.hpp"
#include "support/moving_chain.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using testing::any_chain;
using testing::any_pose;
using testing::ball_mesh;
using testing::box_mesh;
using testing::Chain;
using testing::torus_mesh;

constexpr double margin = 0.00005;
constexpr double tolerance = 0.001;

std::vector<Sphere> balls_about(const TriangleMesh& mesh) {
  const MeshBvh bvh(mesh);
  return grow_to_hold(bvh, cover_with_inner_spheres(mesh, bvh, tolerance));
}

BallCover cover_of(const TriangleMesh& mesh) {
  return BallCover(balls_about(mesh));
}

/// How far the point sticks out of all balls; negative inside one.
double excess(const std::vector<Sphere>& balls, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& s : balls) least = std::min(least, (p - s.center).norm() - s.radius);
  return least;
}

TEST(BallCover, HoldsAllOfTheSurfaceAndLittleMore) {
  TriangleMesh two = box_mesh({0.06, 0.02, 0.03});
  append(two, box_mesh({0.01, 0.01, 0.01}));  // hidden inside
  for (const TriangleMesh& mesh : {torus_mesh(0.03, 0.008, 24), box_mesh({0.05, 0.02, 0.08}), two}) {
    const std::vector<Sphere> balls = balls_about(mesh);
    for (const Vec3& p : sample_surface(mesh, 0.0005).points) EXPECT_LE(excess(balls, p), 1e-7);
    const MeshBvh bvh(mesh);
    for (const Sphere& s : balls) EXPECT_LE(s.radius, -bvh.signed_distance(s.center) + 2.4 * tolerance);
  }
}

TEST(BallCover, HoldsLooseSheetsThatTheSpheresMiss) {
  TriangleMesh mesh = ball_mesh(0.01, 10);
  const std::vector<Sphere> spheres{{Vec3::Zero(), 0.0095}};
  append(mesh, box_mesh({0.002, 0.05, 0.001}));
  const std::vector<Sphere> balls = grow_to_hold(MeshBvh(mesh), spheres);
  ASSERT_EQ(balls.size(), 1u);
  for (const Vec3& p : sample_surface(mesh, 0.0005).points) EXPECT_LE(excess(balls, p), 1e-7);
  EXPECT_TRUE(BallCover(grow_to_hold(MeshBvh(mesh), {})).empty());
}

TEST(BallCover, NothingComesNearerThanTheMarginVsExactDistances) {
  RandomStream random{41};
  const TriangleMesh link = box_mesh({0.02, 0.05, 0.015});
  const MeshBvh b(link);
  const BallCover cover = cover_of(link);
  int limited = 0;
  for (const double scale : {1.0, 0.8}) {
    TriangleMesh torus = torus_mesh(0.04, 0.01, 32);
    const DistanceField field = DistanceField(MeshBvh(torus)).scaled(scale);
    for (Vec3& p : torus.vertices) p *= scale;
    const MeshBvh a(torus);
    for (int i = 0; i < 100; ++i) {
      const Pose X_AB = any_pose(random, i % 4 == 0 ? 0.5 : 0.1);
      const Chain arm = any_chain(random, a.box());
      const auto screws = arm.screws();
      const double time = cover.free_time(field, X_AB, {{}, screws, arm.acceleration(1.2)}, margin, 0.5);
      const double distance = closest_pair(a, b, X_AB).distance;
      if (distance <= margin) {
        EXPECT_EQ(time, 0.0);
      }
      limited += time > 0.0 && time < 1.0;
      // The outer joint may stop anywhere on the way.
      for (const double share : {0.25, 0.5, 1.0})
        for (const double outer : {0.0, 0.5, 1.0}) {
          const double t = share * std::min(time, 1.0);
          EXPECT_GE(closest_pair(a, b, arm.at(t, outer * t) * X_AB).distance,
                    std::min(margin, distance) - 1e-7);
        }
    }
  }
  EXPECT_GT(limited, 50);
}

TEST(BallCover, TellsMostOfAStraightWay) {
  const MeshBvh wall(box_mesh({0.1, 0.1, 0.02}));
  const DistanceField field(wall);
  const BallCover cover = cover_of(box_mesh({0.02, 0.04, 0.02}));
  for (const double gap : {0.004, 0.01, 0.03, 0.15, 0.4}) {
    Pose X = Pose::Identity();
    X.translation().z() = 0.02 + gap;
    const Screw fall{Vec3::Zero(), {0.0, 0.0, -1.0}};
    const double time = cover.free_time(field, X, {{}, {&fall, 1}, 0.0}, 0.0, 10.0);
    EXPECT_LE(time, gap);
    EXPECT_GE(time, 0.72 * gap - 0.001);
  }
}

TEST(BallCover, EndsEarlyWhereTheTimeIsTooShortOrLongEnough) {
  const DistanceField field(MeshBvh(ball_mesh(0.03, 16)));
  const BallCover cover = cover_of(box_mesh({0.02, 0.04, 0.02}));
  Pose X = Pose::Identity();
  X.translation().x() = 0.07;
  const Screw fall{Vec3::Zero(), {-1.0, 0.0, 0.0}};
  const SurfaceMotion motion{{}, {&fall, 1}, 0.0};
  const double time = cover.free_time(field, X, motion, 0.0, 10.0);
  EXPECT_LT(cover.free_time(field, X, motion, 0.0, 10.0, 2.0 * time), 2.0 * time);
  const double bound = cover.free_time(field, X, motion, 0.0, 0.1 * time);
  EXPECT_GE(bound, 0.1 * time);
  EXPECT_LE(bound, time);
  EXPECT_EQ(BallCover().free_time(field, X, motion, 0.0, 10.0), 0.0);
}

TEST(BallCover, AllInstructionSetsGiveTheSameBits) {
  RandomStream random{43};
  const DistanceField field(MeshBvh(torus_mesh(0.03, 0.01, 24)));
  const auto view = [](const FieldGrid& grid) {
    ball_kernel::GridView v{};
    v.values = reinterpret_cast<const std::int32_t*>(grid.values.data());
    for (int k = 0; k < 3; ++k) {
      v.origin[k] = static_cast<float>(grid.origin[k]);
      v.last[k] = static_cast<float>(grid.nodes[k] - 1);
    }
    v.cell = static_cast<float>(grid.cell);
    v.inverse_cell = static_cast<float>(1.0 / grid.cell);
    v.row = grid.nodes.x();
    v.layer = grid.nodes.x() * grid.nodes.y();
    return v;
  };
  for (int i = 0; i < 300; ++i) {
    ball_kernel::Motion motion{};
    motion.fine = view(field.fine());
    motion.coarse = view(field.coarse());
    motion.scale = 1.0f;
    const Pose X = any_pose(random, 0.1);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) motion.rotation[r][c] = static_cast<float>(X.linear()(r, c));
    ball_kernel::Joint joints[2] = {};
    for (auto& joint : joints)
      for (int k = 0; k < 3; ++k) {
        joint.angular[k] = static_cast<float>(random.uniform(-1.0, 1.0));
        joint.linear[k] = static_cast<float>(random.uniform(-0.1, 0.1));
      }
    motion.joints = joints;
    motion.n = 2;
    motion.margin = 0.00005f;
    motion.acceleration = 0.2f;
    ball_kernel::BallPack balls{};
    const double reach = i % 3 == 0 ? 0.02 : i % 3 == 1 ? 0.1 : 0.6;
    for (int k = 0; k < kernel::n_lanes; ++k) {
      for (float* row : {balls.x, balls.y, balls.z})
        row[k] = static_cast<float>(random.uniform(-reach, reach));
      balls.radius[k] = static_cast<float>(random.uniform(0.0, 0.01));
    }
    alignas(64) float expected[kernel::n_lanes];
    ball_kernel::baseline_functions.times(motion, balls, expected);
    for (const InstructionSet set : available_instruction_sets()) {
      if (set == InstructionSet::baseline) continue;
      alignas(64) float found[kernel::n_lanes];
      EIGENGRASP_VARIANT(ball_kernel, set).times(motion, balls, found);
      EXPECT_EQ(std::memcmp(found, expected, sizeof found), 0) << i;
    }
  }
}

}  // namespace
}  // namespace eigengrasp
