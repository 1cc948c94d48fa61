// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "unit/kinematics_hand_builder.hpp"

namespace eigengrasp {
namespace {

VecX random_posture(const HandModel& hand, RandomStream& random) {
  VecX p(hand.n_dof());
  for (double& x : p) x = random.uniform(-1.0, 1.0);
  return p;
}

TEST(ForwardKinematics, PlanarTwoLinkArmInClosedForm) {
  HandModel hand;
  hand.links.resize(3);
  hand.dofs = {{"a", DofType::rigid, -3, 3, 0, 1}};
  HandJoint shoulder;
  shoulder.dof = 0;
  HandJoint elbow = shoulder;
  elbow.parent_link = 1;
  elbow.X_PJ.translation() = Vec3(0.3, 0, 0);
  elbow.ratio = 0.5;
  elbow.offset = 0.1;
  hand.joints = {shoulder, elbow};
  const VecX joints = joint_values(hand, VecX::Constant(1, 0.8));
  EXPECT_DOUBLE_EQ(joints[1], 0.5);
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joints, Pose::Identity(), X_OL);
  const Vec3 tip = X_OL[2] * Vec3(0.2, 0, 0);
  const Vec3 expected(0.3 * std::cos(0.8) + 0.2 * std::cos(1.3), 0.3 * std::sin(0.8) + 0.2 * std::sin(1.3),
                      0);
  EXPECT_LT((tip - expected).norm(), 1e-15);
}

TEST(ForwardKinematics, RotationMatchesEigenAngleAxis) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    HandModel hand = testing::random_hand(seed, 1);
    hand.joints[0].type = JointType::revolute;
    RandomStream random{seed, 5};
    const Pose X_OH = testing::random_pose(random, 1.0);
    const double angle = random.uniform(-3.0, 3.0);
    std::vector<Pose> X_OL;
    compute_link_poses(hand, VecX::Constant(1, angle), X_OH, X_OL);
    const Pose expected = X_OH * hand.joints[0].X_PJ * Eigen::AngleAxisd(angle, hand.joints[0].axis_J);
    EXPECT_LT((X_OL[1].matrix() - expected.matrix()).norm(), 1e-14);
  }
}

TEST(ForwardKinematics, PointVelocityVsCentralDifferences) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const HandModel hand = testing::random_hand(seed, 14);
    RandomStream random{seed, 2};
    const Pose X_OH = testing::random_pose(random, 0.5);
    const VecX joints = joint_values(hand, random_posture(hand, random));
    std::vector<Pose> X, X_plus, X_minus;
    compute_link_poses(hand, joints, X_OH, X);
    const int link = static_cast<int>(random.uniform(0.0, hand.n_links()));
    const auto l = static_cast<std::size_t>(link);
    const Vec3 p_L = 0.05 * testing::random_unit(random);
    constexpr double h = 1e-5;
    for (int j = 0; j < hand.n_joints(); ++j) {
      VecX moved = joints;
      moved[j] = joints[j] + h;
      compute_link_poses(hand, moved, X_OH, X_plus);
      moved[j] = joints[j] - h;
      compute_link_poses(hand, moved, X_OH, X_minus);
      const Vec3 difference = (X_plus[l] * p_L - X_minus[l] * p_L) / (2.0 * h);
      EXPECT_LT((point_velocity(hand, X, link, j, X[l] * p_L) - difference).norm(), 1e-9) << "joint " << j;
      if (!moves_link(hand, j, link)) {
        EXPECT_EQ(difference, Vec3::Zero());
      }
    }
  }
}

TEST(ForwardKinematics, ClampsToTheLimits) {
  const HandModel hand = testing::random_hand(4, 6);
  const VecX p = VecX::LinSpaced(hand.n_dof(), -5.0, 5.0);
  const VecX c = clamp_posture(hand, p);
  EXPECT_EQ(c, p.cwiseMax(hand.dof_min()).cwiseMin(hand.dof_max()));
}

TEST(ForwardKinematics, PostureOfJointsInvertsTheCouplings) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const HandModel hand = testing::random_hand(seed, 10);
    RandomStream random{seed, 3};
    const VecX p = random_posture(hand, random);
    EXPECT_LT((posture_of_joints(hand, joint_values(hand, p)) - p).norm(), 1e-13);
  }
}

TEST(ForwardKinematics, PostureOfJointsAfterBreakAwayFollowsTheFurthestJoint) {
  HandModel hand;
  hand.links.resize(3);
  hand.dofs = {{"finger", DofType::breakaway, 0.0, 2.0, 0.0, 1.0}};
  HandJoint proximal;
  proximal.dof = 0;
  HandJoint distal = proximal;
  distal.parent_link = 1;
  distal.ratio = 1.0 / 3.0;
  distal.offset = 0.7;
  hand.joints = {proximal, distal};
  // The proximal joint was stopped at 0.5, the distal one went on to the value of dof = 1.2.
  const VecX joints = (VecX(2) << 0.5, 0.7 + 1.2 / 3.0).finished();
  EXPECT_NEAR(posture_of_joints(hand, joints)[0], 1.2, 1e-15);
  hand.dofs[0].closing_speed = -1.0;  // closes downwards: 0.5 is further
  EXPECT_NEAR(posture_of_joints(hand, joints)[0], 0.5, 1e-15);
}

TEST(ForwardKinematics, PostureOfJointsKeepsRestOfADofWithoutJoints) {
  HandModel hand;
  hand.links.resize(1);
  hand.dofs = {{"idle", DofType::rigid, 0.0, 2.0, 0.25, 1.0}};
  EXPECT_EQ(posture_of_joints(hand, VecX(0))[0], 0.25);
}

}  // namespace
}  // namespace eigengrasp
