// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// What a hand may not touch: fast and exact checks of simple hands whose collisions are known.
#include <gtest/gtest.h>

#include <map>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "support/parallel_gripper.hpp"

namespace eigengrasp {
namespace {

using testing::at;
using testing::box_mesh;
using testing::scene_of;
using testing::solid;

std::vector<Pose> pose_gripper(const HandModel& hand, double q, const Pose& X_OH) {
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joint_values(hand, VecX::Constant(hand.n_dof(), q)), X_OH, X_OL);
  return X_OL;
}

/// A box of 40 mm between the fingers, whose faces it meets at q = 25 mm.
Scene box_between_fingers(std::vector<Obstacle> obstacles = {}) {
  return scene_of(testing::parallel_gripper(), solid(box_mesh({0.04, 0.04, 0.04}), {0.0, 0.0, 0.03}),
                  std::move(obstacles));
}

TEST(CollisionModel, FingersOnABoxAreLegalUntilTheyEnterIt) {
  const CollisionModel model(box_between_fingers(), {});
  const HandModel& hand = *model.scene().hand;
  const Pose X_OH = Pose::Identity();
  for (const double q : {0.0, 0.020, 0.0249})
    EXPECT_EQ(model.check_exact(pose_gripper(hand, q, X_OH)), Legality::legal) << q;
  for (const double q : {0.0251, 0.030, 0.040})
    EXPECT_EQ(model.check_exact(pose_gripper(hand, q, X_OH)), Legality::hits_object) << q;
  CollisionModel::Options options;
  options.refuse_depth = 0.0;
  const CollisionModel without_margin(model.scene(), options);
  for (const double q : {0.0, 0.020, 0.0249})
    EXPECT_EQ(without_margin.check_fast(pose_gripper(hand, q, X_OH)), Legality::legal) << q;
  for (const double q : {0.0, 0.020, 0.0245})
    EXPECT_EQ(model.check_fast(pose_gripper(hand, q, X_OH)), Legality::legal) << q;
  for (const double q : {0.0260, 0.0275, 0.030, 0.040})
    EXPECT_EQ(model.check_fast(pose_gripper(hand, q, X_OH)), Legality::hits_object) << q;
}

TEST(CollisionModel, FingersMeetEachOther) {
  const Scene scene =
      scene_of(testing::parallel_gripper(DofType::rigid, 0.06), solid(box_mesh({0.04, 0.04, 0.04})));
  const CollisionModel model(scene, {});
  const Pose away = at(0.0, 0.0, 0.3);
  EXPECT_EQ(model.check_exact(pose_gripper(*scene.hand, 0.0449, away)), Legality::legal);
  EXPECT_EQ(model.check_exact(pose_gripper(*scene.hand, 0.0451, away)), Legality::hits_itself);
  EXPECT_EQ(model.check_fast(pose_gripper(*scene.hand, 0.0440, away)), Legality::legal);
  EXPECT_EQ(model.check_fast(pose_gripper(*scene.hand, 0.0470, away)), Legality::hits_itself);
}

TEST(CollisionModel, TheTableIsAnObstacle) {
  const CollisionModel model(box_between_fingers({make_table(0.01)}), {});
  const HandModel& hand = *model.scene().hand;
  const Pose from_above = make_pose(Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 0.075});
  EXPECT_EQ(model.check_exact(pose_gripper(hand, 0.0, from_above)), Legality::legal);
  EXPECT_EQ(model.check_fast(pose_gripper(hand, 0.0, from_above)), Legality::legal);
  Pose lower = from_above;
  lower.translation().z() = 0.0705;  // tips at 9.5 mm
  EXPECT_EQ(model.check_exact(pose_gripper(hand, 0.0, lower)), Legality::hits_obstacle);
  lower.translation().z() = 0.065;
  EXPECT_EQ(model.check_exact(pose_gripper(hand, 0.0, lower)), Legality::hits_obstacle);
  EXPECT_EQ(model.check_fast(pose_gripper(hand, 0.0, lower)), Legality::hits_obstacle);
}

TEST(CollisionModel, OneInsideTheOtherCollides) {
  const Scene small_hand =
      scene_of(testing::pad(testing::ball_mesh(0.01, 12)), solid(box_mesh({0.1, 0.1, 0.1})));
  const Scene small_object =
      scene_of(testing::pad(box_mesh({0.1, 0.1, 0.1})), solid(testing::ball_mesh(0.01, 12)));
  for (const Scene& scene : {small_hand, small_object}) {
    const CollisionModel model(scene, {});
    const std::vector<Pose> X_OL{at(0.005, 0.0, 0.0)};
    EXPECT_EQ(model.check_exact(X_OL), Legality::hits_object);
    EXPECT_EQ(model.check_fast(X_OL), Legality::hits_object);
    const auto overlap = model.overlap_with_object(0, X_OL[0]);
    EXPECT_FALSE(overlap.crosses);
    EXPECT_TRUE(overlap.contained);
  }
}

TEST(CollisionModel, FastAgreesWithExactButForShallowIntrusions) {
  RandomStream random{1};
  const Scene scene = scene_of(testing::two_finger_hand(), solid(testing::torus_mesh(0.03, 0.012)));
  const HandModel& hand = *scene.hand;
  const CollisionModel model(scene, {});
  int legal = 0, illegal = 0;
  for (int i = 0; i < 600; ++i) {
    VecX posture(2);
    for (Eigen::Index d = 0; d < 2; ++d) posture[d] = random.uniform(-0.2, 1.0);
    std::vector<Pose> X_OL;
    compute_link_poses(hand, joint_values(hand, posture), testing::any_pose(random, 0.1), X_OL);
    const bool exact = model.check_exact(X_OL) == Legality::legal;
    const bool fast = model.check_fast(X_OL) == Legality::legal;
    if (exact) {
      EXPECT_TRUE(fast) << i;
    }
    if (fast && !exact) {
      EXPECT_LT(model.deepest_penetration(X_OL), 0.0025) << i;
    }
    if (exact) {
      EXPECT_EQ(model.deepest_penetration(X_OL), 0.0) << i;
    }
    legal += exact;
    illegal += !exact;
  }
  EXPECT_GT(legal, 100);
  EXPECT_GT(illegal, 100);
}

// The fields of the object and of the links spare search and decide nothing.
TEST(CollisionModel, ExactChecksAreTheSameWithAndWithoutFields) {
  RandomStream random{2};
  const Scene scene = scene_of(testing::two_finger_hand(), solid(testing::torus_mesh(0.03, 0.012)));
  const CollisionModel with(scene, {});
  const CollisionModel without = testing::exact_model(scene);
  std::map<Legality, int> found;
  for (int i = 0; i < 600; ++i) {
    const VecX posture = VecX::Constant(2, random.uniform(-0.2, 1.2));
    std::vector<Pose> X_OL;
    compute_link_poses(*scene.hand, joint_values(*scene.hand, posture), testing::any_pose(random, 0.12),
                       X_OL);
    EXPECT_EQ(with.check_exact(X_OL), without.check_exact(X_OL)) << i;
    if (i % 10 == 0) {
      EXPECT_EQ(with.deepest_penetration(X_OL), without.deepest_penetration(X_OL)) << i;
    }
    ++found[without.check_exact(X_OL)];
  }
  EXPECT_GT(found[Legality::legal], 50);
  EXPECT_GT(found[Legality::hits_object], 50);
}

TEST(CollisionModel, DeepestPenetrationOfAKnownOverlap) {
  const CollisionModel boxes = testing::exact_model(
      scene_of(testing::pad(box_mesh({0.02, 0.02, 0.02})), solid(box_mesh({0.06, 0.06, 0.06}))));
  for (const double depth : {0.0004, 0.001, 0.003})
    EXPECT_NEAR(boxes.deepest_penetration({at(0.004, 0.003, 0.04 - depth)}), depth, 1e-9);
  EXPECT_EQ(boxes.deepest_penetration({at(0.0, 0.0, 0.0401)}), 0.0);

  // The pole of the ball is a vertex of its mesh.
  const CollisionModel ball = testing::exact_model(
      scene_of(testing::pad(testing::ball_mesh(0.01)), solid(box_mesh({0.06, 0.06, 0.06}))));
  EXPECT_NEAR(ball.deepest_penetration({at(0.0, 0.0, 0.03 + 0.01 - 0.0007)}), 0.0007, 1e-6);

  // A needle of the object in the hand: the depth is that of its tip.
  const CollisionModel needle =
      testing::exact_model(scene_of(testing::pad(box_mesh({0.04, 0.04, 0.04})),
                                    solid(testing::revolve({{0.0, 0.0}, {0.002, 0.0}, {0.0, 0.03}}, 12))));
  EXPECT_NEAR(needle.deepest_penetration({at(0.0, 0.0, 0.02 + 0.025)}), 0.005, 2e-4);
}

TEST(CollisionModel, DistancesAreLowerBoundsAndExactBelowTheBound) {
  const Scene scene = box_between_fingers({make_table(-0.1)});
  const CollisionModel model = testing::exact_model(scene);
  const auto X_OL = pose_gripper(*scene.hand, 0.020, Pose::Identity());
  EXPECT_NEAR(model.distance_to_object(1, X_OL[1], 0.01), 0.005, 1e-12);
  EXPECT_NEAR(model.distance_to_object(2, X_OL[2], 0.01), 0.005, 1e-12);
  EXPECT_NEAR(model.distance_of_links(1, 2, X_OL, 0.06), 0.05, 1e-12);
  EXPECT_NEAR(model.distance_to_obstacle(0, 1, X_OL[1], 0.2), 0.101, 1e-12);
  EXPECT_LE(model.distance_to_obstacle(0, 1, X_OL[1], 0.001), 0.101);
  EXPECT_GT(model.distance_to_obstacle(0, 1, X_OL[1], 0.001), 0.001);
  EXPECT_EQ(model.distance_to_object(1, pose_gripper(*scene.hand, 0.03, Pose::Identity())[1], 0.01), 0.0);
}

TEST(CollisionModel, LegalityHasAName) {
  EXPECT_STREQ(describe(Legality::legal), "is legal");
  EXPECT_STREQ(describe(Legality::hits_object), "collides with the object");
  EXPECT_STREQ(describe(Legality::hits_itself), "collides with itself");
  EXPECT_STREQ(describe(Legality::hits_obstacle), "collides with an obstacle");
}

TEST(Scene, ReachOfTheGripper) {
  EXPECT_NEAR(hand_reach(*testing::parallel_gripper()), Vec3(0.055, 0.01, 0.061).norm(), 1e-9);
}

}  // namespace
}  // namespace eigengrasp
