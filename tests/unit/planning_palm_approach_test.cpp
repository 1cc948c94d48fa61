// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Where a hand that moves towards something stops: against closed forms and small steps.
#include "eigengrasp/planning/palm_approach.hpp"

#include <gtest/gtest.h>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "support/parallel_gripper.hpp"

namespace eigengrasp {
namespace {

using testing::at;
using testing::ball_mesh;
using testing::box_mesh;
using testing::exact_model;
using testing::parallel_gripper;
using testing::scene_of;
using testing::solid;

constexpr double gap = 0.0001;

PalmApproach approach(const Scene& scene, const Pose& X_OH, double max_travel) {
  const VecX joints = joint_values(*scene.hand, scene.hand->rest_posture());
  return approach_until_contact(exact_model(scene), X_OH, joints, max_travel, gap);
}

// The palm's face is at z = 0, the fingers reach to z = 0.061 at x = -+0.045.
TEST(PalmApproach, PalmStopsOnTheTopOfABox) {
  const Scene scene = scene_of(parallel_gripper(), solid(box_mesh({0.04, 0.04, 0.04}, {0, 0, 0.1})));
  const PalmApproach result = approach(scene, at(0.0, 0.0, 0.01), 0.2);
  EXPECT_TRUE(result.touches);
  EXPECT_LE(result.travel, 0.07);
  EXPECT_GE(result.travel, 0.07 - gap);
  EXPECT_NEAR((result.X_OH.translation() - Vec3(0.0, 0.0, 0.01 + result.travel)).norm(), 0.0, 1e-15);
  EXPECT_TRUE(result.X_OH.linear().isIdentity(0.0));
}

TEST(PalmApproach, ATurnedHandMovesAlongItsOwnDirection) {
  Pose X_OH = Pose::Identity();
  X_OH.linear() = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitY()).toRotationMatrix();  // z to x
  const Scene scene = scene_of(parallel_gripper(), solid(ball_mesh(0.02), {0.1, 0.0, 0.0}));
  const PalmApproach result = approach(scene, X_OH, 0.2);
  EXPECT_TRUE(result.touches);
  EXPECT_NEAR(result.travel, 0.08, 2.0 * gap);
  EXPECT_NEAR(result.X_OH.translation().x(), result.travel, 1e-12);
}

TEST(PalmApproach, EndsWithItsTravel) {
  const Scene scene = scene_of(parallel_gripper(), solid(box_mesh({0.04, 0.04, 0.04}, {0, 0, 0.1})));
  const PalmApproach result = approach(scene, Pose::Identity(), 0.03);
  EXPECT_FALSE(result.touches);
  EXPECT_EQ(result.travel, 0.03);
  EXPECT_EQ(approach(scene, Pose::Identity(), 0.0).travel, 0.0);
}

TEST(PalmApproach, AnObstacleStopsTheFingers) {
  const Obstacle wall{solid(box_mesh({0.01, 0.01, 0.01})), at(0.05, 0.0, 0.08)};
  const Scene scene = scene_of(parallel_gripper(), solid(ball_mesh(0.02), {0, 0, 0.1}), {wall});
  const PalmApproach result = approach(scene, Pose::Identity(), 0.2);
  EXPECT_TRUE(result.touches);
  EXPECT_NEAR(result.travel, 0.075 - 0.061, gap);
}

TEST(PalmApproach, AHandInCollisionStays) {
  const Scene scene = scene_of(parallel_gripper(), solid(ball_mesh(0.05), {0, 0, 0.03}));
  const PalmApproach result = approach(scene, Pose::Identity(), 0.2);
  EXPECT_TRUE(result.touches);
  EXPECT_EQ(result.travel, 0.0);
}

TEST(PalmApproach, StopsWhereSmallStepsFirstTouch) {
  RandomStream random{7};
  const Scene scene = scene_of(testing::two_finger_hand(), solid(testing::torus_mesh(0.03, 0.012)));
  const CollisionModel model = exact_model(scene);
  const VecX joints = joint_values(*scene.hand, scene.hand->rest_posture());
  std::vector<Pose> X_OL;
  int stopped = 0;
  for (int i = 0; i < 80; ++i) {
    const Pose X_OH = testing::any_pose(random, 0.1);
    compute_link_poses(*scene.hand, joints, X_OH, X_OL);
    if (model.check_exact(X_OL) != Legality::legal) continue;
    const PalmApproach result = approach_until_contact(model, X_OH, joints, 0.15, gap);
    stopped += result.touches;
    const auto legal_after = [&](double travel) {
      compute_link_poses(*scene.hand, joints,
                         X_OH * Eigen::Translation3d(travel * scene.hand->approach_direction_H), X_OL);
      return model.check_exact(X_OL) == Legality::legal;
    };
    for (double travel = 0.0; travel < result.travel; travel += 0.001) EXPECT_TRUE(legal_after(travel)) << i;
    EXPECT_TRUE(legal_after(result.travel)) << i;
    if (!result.touches) continue;
    double nearest = 1.0;
    for (int link = 0; link < scene.hand->n_links(); ++link)
      nearest = std::min(nearest, model.distance_to_object(link, X_OL[static_cast<std::size_t>(link)], 0.01));
    EXPECT_LE(nearest, gap) << i;
  }
  EXPECT_GT(stopped, 5);
}

}  // namespace
}  // namespace eigengrasp
