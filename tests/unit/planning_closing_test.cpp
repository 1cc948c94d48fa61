// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Where the fingers of simple grippers stop.
#include "eigengrasp/planning/finger_closing.hpp"

#include <gtest/gtest.h>

#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "support/parallel_gripper.hpp"

namespace eigengrasp {
namespace {

using testing::at;
using testing::box_mesh;
using testing::exact_model;
using testing::parallel_gripper;
using testing::scene_of;
using testing::solid;

constexpr double gap = 0.0001;  // that close_fingers leaves at most

ClosedHand close(const Scene& scene, const Pose& X_OH = Pose::Identity()) {
  return close_fingers(exact_model(scene), X_OH, scene.hand->rest_posture());
}

double distance_to_object(const Scene& scene, const ClosedHand& closed, int link) {
  return exact_model(scene).distance_to_object(link, closed.X_OL[static_cast<std::size_t>(link)], 0.05);
}

void expect_touch(double distance) {
  EXPECT_GT(distance, 0.0);
  EXPECT_LE(distance, gap);
}

TEST(CloseFingers, ParallelGripperStopsOnABallAndOnABox) {
  for (const auto& object :
       {solid(testing::ball_mesh(0.015), {0, 0, 0.03}), solid(box_mesh({0.03, 0.03, 0.03}), {0, 0, 0.03})}) {
    const Scene scene = scene_of(parallel_gripper(), object);
    const ClosedHand closed = close(scene);
    EXPECT_FALSE(closed.started_in_collision);
    EXPECT_GT(closed.steps, 1);
    EXPECT_LT(closed.steps, 500);
    EXPECT_NEAR(closed.dofs[0], 0.030, 2.0 * gap);
    for (const int finger : {1, 2}) expect_touch(distance_to_object(scene, closed, finger));
    EXPECT_EQ(exact_model(scene).check_exact(closed.X_OL), Legality::legal);
  }
}

TEST(CloseFingers, StopsAtTheLimit) {
  const Scene scene =
      scene_of(parallel_gripper(DofType::rigid, 0.020), solid(testing::ball_mesh(0.015), {0, 0, 0.03}));
  const ClosedHand closed = close(scene);
  EXPECT_EQ(closed.dofs[0], 0.020);
  EXPECT_EQ(closed.joints[0], 0.020);
  EXPECT_EQ(closed.joints[1], 0.020);
}

TEST(CloseFingers, FingerStopsAgainstFinger) {
  const Scene scene =
      scene_of(parallel_gripper(DofType::rigid, 0.06), solid(testing::ball_mesh(0.015), {0, 0, 0.5}));
  const ClosedHand closed = close(scene);
  expect_touch(exact_model(scene).distance_of_links(1, 2, closed.X_OL, 0.05));
  EXPECT_NEAR(closed.dofs[0], 0.045, gap);
}

// The ball is nearer to the right finger.
TEST(CloseFingers, CoupledRigidFingersStopTogetherAndBreakawayOnesDoNot) {
  const auto ball = solid(testing::ball_mesh(0.015), {0.008, 0, 0.03});
  const Scene rigid = scene_of(parallel_gripper(DofType::rigid), ball);
  const ClosedHand stopped = close(rigid);
  expect_touch(distance_to_object(rigid, stopped, 2));
  EXPECT_EQ(stopped.joints[0], stopped.joints[1]);
  EXPECT_NEAR(stopped.joints[1], 0.045 - 0.023, 2.0 * gap);

  const Scene breakaway = scene_of(parallel_gripper(DofType::breakaway), ball);
  const ClosedHand went_on = close(breakaway);
  for (const int finger : {1, 2}) expect_touch(distance_to_object(breakaway, went_on, finger));
  EXPECT_NEAR(went_on.joints[1], 0.045 - 0.023, 2.0 * gap);
  EXPECT_NEAR(went_on.joints[0], 0.045 - 0.007, 2.0 * gap);
  EXPECT_NEAR(went_on.dofs[0], went_on.joints[0], 1e-12) << "the joint that went furthest";
}

// A small ball stops the left proximal link; the distal link turns about it, further than its coupling says.
TEST(CloseFingers, DistalJointGoesOnWhenTheProximalOneIsStopped) {
  const Scene scene =
      scene_of(testing::two_finger_hand(), solid(testing::ball_mesh(0.006), {-0.032, 0.0, 0.045}));
  const ClosedHand closed = close(scene);
  expect_touch(distance_to_object(scene, closed, 1));
  EXPECT_GT(closed.joints[0], 0.05);
  EXPECT_LT(closed.joints[0], 0.3);
  EXPECT_GT(closed.joints[1], 0.5 * closed.joints[0] + 0.2);
  EXPECT_EQ(exact_model(scene).check_exact(closed.X_OL), Legality::legal);
}

TEST(CloseFingers, AnObstacleStops) {
  const Obstacle post{solid(box_mesh({0.01, 0.01, 0.2})), at(-0.035, 0.0, 0.1)};
  const Scene scene = scene_of(parallel_gripper(), solid(testing::ball_mesh(0.01), {0, 0, 0.03}), {post});
  const ClosedHand closed = close(scene);
  EXPECT_NEAR(closed.dofs[0], 0.005, gap);
  expect_touch(exact_model(scene).distance_to_obstacle(0, 1, closed.X_OL[1], 0.05));
  EXPECT_GT(distance_to_object(scene, closed, 1), 0.02);
}

TEST(CloseFingers, AStartInCollisionIsReportedAndNothingMoves) {
  const Scene scene = scene_of(parallel_gripper(), solid(testing::ball_mesh(0.05), {0, 0, 0.03}));
  const ClosedHand closed = close(scene);
  EXPECT_TRUE(closed.started_in_collision);
  EXPECT_EQ(closed.dofs, scene.hand->rest_posture());
  EXPECT_EQ(closed.steps, 0);
}

TEST(CloseFingers, ADegreeOfFreedomWithoutClosingSpeedStays) {
  auto hand = parallel_gripper();
  hand->dofs[0].closing_speed = 0.0;
  const ClosedHand closed = close(scene_of(hand, solid(testing::ball_mesh(0.015), {0, 0, 0.03})));
  EXPECT_EQ(closed.dofs[0], 0.0);
}

TEST(CloseFingers, OpensWhereTheClosingSpeedIsNegative) {
  auto hand = parallel_gripper();
  hand->dofs[0].closing_speed = -0.1;
  const Scene scene = scene_of(hand, solid(testing::ball_mesh(0.005), {0, 0, 0.03}));
  const ClosedHand closed = close_fingers(exact_model(scene), Pose::Identity(), VecX::Constant(1, 0.03));
  EXPECT_EQ(closed.dofs[0], 0.0);
}

TEST(CloseFingers, IsDeterministicAndNeverPenetrates) {
  RandomStream random{1};
  int closed_hands = 0;
  const Scene scene = scene_of(testing::two_finger_hand(), solid(testing::torus_mesh(0.03, 0.012)));
  const CollisionModel model = exact_model(scene);
  std::vector<Pose> X_OL;
  for (int i = 0; i < 60; ++i) {
    const Pose X_OH = testing::any_pose(random, 0.1);
    const VecX posture = scene.hand->rest_posture();
    compute_link_poses(*scene.hand, joint_values(*scene.hand, posture), X_OH, X_OL);
    if (model.check_exact(X_OL) != Legality::legal) continue;
    const ClosedHand a = close_fingers(model, X_OH, posture);
    const ClosedHand b = close_fingers(model, X_OH, posture);
    EXPECT_EQ(a.joints, b.joints);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(model.check_exact(a.X_OL), Legality::legal) << i;
    for (int j = 0; j < scene.hand->n_joints(); ++j) EXPECT_LE(a.joints[j], 1.2);
    ++closed_hands;
  }
  EXPECT_GT(closed_hands, 10);
}

void expect_same(const std::vector<GraspContact>& a, const std::vector<GraspContact>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].link, b[i].link);
    EXPECT_EQ(a[i].patch, b[i].patch);
    EXPECT_EQ(a[i].point.p_OC, b[i].point.p_OC);
    EXPECT_EQ(a[i].point.n_OC, b[i].point.n_OC);
    EXPECT_EQ(a[i].point.mu, b[i].point.mu);
    EXPECT_EQ(a[i].point.torsion_length, b[i].point.torsion_length);
  }
}

// What closing knows spares search and changes nothing, to the last bit; with and without fields.
TEST(CloseFingers, WhatIsKnownOfTheClosedHandChangesNoContact) {
  auto hand = testing::two_finger_hand();
  set_collision_pairs(*hand, {});
  for (HandLink& link : hand->links) link.material.youngs_modulus = 1.5e6;
  const Obstacle post{solid(box_mesh({0.02, 0.02, 0.2})), at(-0.07, 0.0, 0.1)};
  const Scene scene = scene_of(hand, solid(testing::torus_mesh(0.03, 0.012)), {post});
  int contacts = 0;
  for (const bool fast : {false, true}) {
    CollisionModel::Options options;
    options.fast = fast;
    const CollisionModel model(scene, options);
    RandomStream random{7};
    for (int i = 0; i < 60; ++i) {
      const Pose X_OH = testing::any_pose(random, 0.1);
      const ClosedHand closed = close_fingers(model, X_OH, hand->rest_posture());
      const auto found = find_contacts(model, closed.X_OL);
      expect_same(find_contacts(model, closed.X_OL, {}, &closed.proximity), found);
      EXPECT_EQ(model.deepest_penetration(closed.X_OL, &closed.proximity),
                model.deepest_penetration(closed.X_OL));
      EXPECT_EQ(closed.proximity.object_clearance.empty(), closed.started_in_collision);
      contacts += static_cast<int>(found.size());
    }
  }
  EXPECT_GT(contacts, 100);
}

// No distance between the closed hand's surfaces is less than what is known of it.
TEST(CloseFingers, KnownClearancesAreKept) {
  const Obstacle post{solid(box_mesh({0.02, 0.02, 0.2})), at(-0.05, 0.0, 0.1)};
  const auto hand = testing::two_finger_hand();
  set_collision_pairs(*hand, {});
  const Scene scene = scene_of(hand, solid(testing::ball_mesh(0.02)), {post});
  const CollisionModel model = exact_model(scene);
  const auto n_links = static_cast<std::size_t>(scene.hand->n_links());
  RandomStream random{8};
  int known_pairs = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose X_OH = testing::any_pose(random, 0.1);
    const ClosedHand closed = close_fingers(model, X_OH, scene.hand->rest_posture());
    if (closed.started_in_collision) continue;
    const HandProximity& known = closed.proximity;
    ASSERT_EQ(known.object_clearance.size(), n_links);
    ASSERT_EQ(known.obstacle_clearance.size(), n_links);
    ASSERT_EQ(known.pair_clearance.size(), scene.hand->collision_pairs.size());
    EXPECT_EQ(known.object_clearance[0], 0.0) << "the base does not move and is not followed";
    for (std::size_t link = 1; link < n_links; ++link) {
      const int number = static_cast<int>(link);
      const Pose& X = closed.X_OL[link];
      EXPECT_GT(known.object_clearance[link], 0.0);
      EXPECT_GT(known.obstacle_clearance[link], 0.0);
      EXPECT_GE(model.distance_to_object(number, X, 1.0), known.object_clearance[link]);
      EXPECT_GE(model.distance_to_obstacle(0, number, X, 1.0), known.obstacle_clearance[link]);
    }
    for (std::size_t k = 0; k < known.pair_clearance.size(); ++k) {
      const auto& [a, b] = scene.hand->collision_pairs[k];
      EXPECT_GT(known.pair_clearance[k], 0.0);
      EXPECT_GE(model.distance_of_links(a, b, closed.X_OL, 1.0), known.pair_clearance[k]);
      ++known_pairs;
    }
  }
  EXPECT_GT(known_pairs, 40);
}

}  // namespace
}  // namespace eigengrasp
