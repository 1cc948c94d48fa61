// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The stream of wrist poses against what was put in: late, twice, broken, after a reset of the sender's
// clock; and the cone ahead of the wrist against its geometry.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "eigengrasp/core/error.hpp"
#include "online/approach_space.hpp"
#include "online/online_work.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

using Taken = WristTrack::Taken;
using Variable = VariableTarget::Variable;

WristSample at(double time, double x = 0.0) {
  WristSample sample;
  sample.time = time;
  sample.X_OH.translation().x() = x;
  return sample;
}

TEST(WristTrack, KeepsTheNewestOfAStreamInAnyOrder) {
  WristTrack track;
  EXPECT_FALSE(track.newest().has_value());
  EXPECT_EQ(track.take(at(1.0, 0.1)), Taken::newest);
  EXPECT_EQ(track.take(at(1.2, 0.2)), Taken::newest);
  EXPECT_EQ(track.take(at(1.1, 0.3)), Taken::late);
  EXPECT_EQ(track.take(at(1.2, 0.4)), Taken::duplicate);
  EXPECT_EQ(track.newest()->X_OH.translation().x(), 0.2);
  EXPECT_EQ(track.take(at(500.0, 0.5)), Taken::newest) << "a gap is no reason to refuse";
  EXPECT_EQ(track.counts().taken, 3);
  EXPECT_EQ(track.counts().late, 1);
  EXPECT_EQ(track.counts().duplicate, 1);
}

TEST(WristTrack, FollowsASenderThatBeganAnew) {
  WristTrack track;
  (void)track.take(at(1000.0, 0.1));
  EXPECT_EQ(track.take(at(0.0, 0.2)), Taken::restarted);
  EXPECT_EQ(track.take(at(0.01, 0.3)), Taken::newest);
  EXPECT_EQ(track.newest()->X_OH.translation().x(), 0.3);
}

TEST(WristTrack, RefusesWhatIsNoRigidMotion) {
  WristTrack track;
  (void)track.take(at(1.0, 0.1));
  WristSample scaled = at(2.0);
  scaled.X_OH.linear() *= 1.1;
  WristSample mirrored = at(2.0);
  mirrored.X_OH.linear().col(0) *= -1.0;
  WristSample broken = at(2.0);
  broken.X_OH.translation().y() = std::numeric_limits<double>::quiet_NaN();
  WristSample far = at(2.0, 1e6);
  WristSample no_time = at(std::numeric_limits<double>::infinity());
  for (const WristSample& bad : {scaled, mirrored, broken, far, no_time})
    EXPECT_EQ(track.take(bad), Taken::invalid);
  EXPECT_EQ(track.newest()->time, 1.0);
}

class ApproachSpaceTest : public ::testing::Test {
 protected:
  ApproachSpaceTest() : scene_(testing::ball_scene()), space_(scene_, options_) { space_.follow(wrist_); }

  ApproachState state(double distance, double theta, double phi) const {
    ApproachState s;
    s.distance = distance;
    s.lean = theta * Eigen::Vector2d(std::cos(phi), std::sin(phi));
    s.amplitudes = VecX::Zero(2);
    return s;
  }
  Pose pose(const ApproachState& s) const { return hand_pose(*scene_.hand, space_.hand_state(s)); }

  Scene scene_;
  OnlineOptions options_;
  ApproachSpace space_;
  Pose wrist_ = make_pose(Eigen::Quaterniond(0.3, -0.5, 0.2, 0.7).normalized(), Vec3(0.1, -0.05, 0.12));
};

TEST_F(ApproachSpaceTest, WithoutLeanTheHandMovesStraightAhead) {
  const Pose X_OH = pose(state(0.07, 0.0, 0.0));
  EXPECT_LT((X_OH.linear() - wrist_.linear()).norm(), 1e-12);
  const Vec3 ahead = 0.07 * (wrist_.linear() * scene_.hand->approach_direction_H);
  EXPECT_LT((X_OH.translation() - wrist_.translation() - ahead).norm(), 1e-12);
}

TEST_F(ApproachSpaceTest, LeaningTurnsTheApproachDirectionByThetaAndKeepsTheApproachPointOnTheCone) {
  const Vec3 axis = wrist_.linear() * scene_.hand->approach_direction_H;
  const Vec3 apex = wrist_ * scene_.hand->approach_point_H;
  for (const double phi : {0.0, 1.0, 2.5, -2.0}) {
    const Pose X_OH = pose(state(0.1, 0.4, phi));
    const Vec3 direction = X_OH.linear() * scene_.hand->approach_direction_H;
    EXPECT_NEAR(std::acos(direction.dot(axis)), 0.4, 1e-9);
    EXPECT_LT((X_OH * scene_.hand->approach_point_H - apex - 0.1 * direction).norm(), 1e-12);
    // The turn has no part about the approach direction: the roll stays the operator's.
    const Eigen::AngleAxisd turn(X_OH.linear() * wrist_.linear().transpose());
    EXPECT_NEAR(turn.axis().dot(axis), 0.0, 1e-9);
  }
  const Vec3 a = pose(state(0.0, 0.3, 0.0)).linear() * scene_.hand->approach_direction_H;
  const Vec3 b = pose(state(0.0, 0.3, std::numbers::pi / 2)).linear() * scene_.hand->approach_direction_H;
  EXPECT_NEAR((a - a.dot(axis) * axis).dot(b - b.dot(axis) * axis), 0.0, 1e-12) << "phi is an angle about it";
}

TEST_F(ApproachSpaceTest, ClampKeepsTheLeanInsideTheCone) {
  ApproachState s = state(5.0, 2.0, 0.7);
  space_.clamp(s);
  EXPECT_NEAR(s.lean.norm(), options_.cone_half_angle, 1e-9);
  EXPECT_NEAR(s.distance, space_.cone().farthest, 1e-12);
}

TEST_F(ApproachSpaceTest, TheRegionEndsBehindTheObjectOrAtTheLookAhead) {
  Pose near = Pose::Identity();
  near.translation() = Vec3(0.0, 0.0, -0.05) - scene_.hand->approach_point_H;
  space_.follow(near);
  EXPECT_NEAR(space_.cone().farthest, 0.05 + scene_.object->max_radius, 1e-9);
  near.translation().z() -= 0.2;
  space_.follow(near);
  EXPECT_NEAR(space_.cone().nearest, 0.25 - scene_.object->max_radius - 0.05, 1e-9);
  near.translation().z() += 0.25;
  space_.follow(near);
  EXPECT_NEAR(space_.cone().nearest, -options_.step_back, 1e-12);
  near.translation().z() -= 1.0;
  space_.follow(near);
  EXPECT_NEAR(space_.cone().farthest, options_.look_ahead, 1e-12);
}

TEST_F(ApproachSpaceTest, ATargetNarrowsItsRangeByItsConfidence) {
  const ApproachSpace::Range whole = space_.ranges()[3];
  space_.aim({{Variable::amplitude, 0, 0.5, 1.0}, {Variable::amplitude, 1, 9.0, 0.75}});
  EXPECT_NEAR(space_.ranges()[3].low, 0.5, 1e-12);
  EXPECT_NEAR(space_.ranges()[3].high, 0.5, 1e-12);
  const ApproachSpace::Range& second = space_.ranges()[4];
  EXPECT_NEAR(second.high, 0.5, 1e-12) << "a value out of range counts as the nearest that is in it";
  EXPECT_NEAR(second.low, 0.5 - 0.25 * 1.0, 1e-12);
  space_.aim({{Variable::amplitude, 0, 0.5, 0.0}});
  EXPECT_NEAR(space_.ranges()[3].low, whole.low, 1e-12);
  EXPECT_NEAR(space_.ranges()[3].high, whole.high, 1e-12);
  space_.aim({{Variable::theta, 0, 0.2, 1.0}, {Variable::phi, 0, std::numbers::pi / 2, 1.0}});
  ApproachState s = state(0.0, 0.0, 0.0);
  space_.clamp(s);
  EXPECT_NEAR(s.lean.x(), 0.0, 1e-12);
  EXPECT_NEAR(s.lean.y(), 0.2, 1e-12);
}

TEST_F(ApproachSpaceTest, MovingOnTakesTheWayOffTheDistance) {
  ApproachState s = state(0.15, 0.2, 1.0);
  const Pose before = wrist_;
  const Pose after = wrist_ * Eigen::Translation3d(0.03 * scene_.hand->approach_direction_H);
  space_.follow(after);
  space_.move_on(s, before);
  EXPECT_NEAR(s.distance, 0.12, 1e-12);
  EXPECT_NEAR(s.lean.norm(), 0.2, 1e-12);
}

TEST_F(ApproachSpaceTest, AnOffsetIsSeenFromTheWrist) {
  const Pose X_OH = pose(state(0.1, 0.3, 0.4));
  const ApproachOffset o = offset_from(*scene_.hand, wrist_, X_OH);
  EXPECT_NEAR(o.angle, 0.3, 1e-9);
  EXPECT_NEAR(o.distance, 0.1 * std::cos(0.3), 1e-9);
  EXPECT_NEAR(o.offset, 0.1 * std::sin(0.3), 1e-9);
}

TEST(CheckTargets, RefusesWhatTheHandDoesNotHave) {
  const auto hand = testing::two_finger_hand();
  EXPECT_NO_THROW(
      check_targets({{Variable::dof, 1, 0.3, 0.5}, {Variable::amplitude, 1, 0.0, 1.0}}, *hand, 2));
  EXPECT_THROW(check_targets({{Variable::dof, 2, 0.3, 0.5}}, *hand, 2), Error);
  EXPECT_THROW(check_targets({{Variable::amplitude, -1, 0.3, 0.5}}, *hand, 2), Error);
  EXPECT_THROW(check_targets({{Variable::distance, 0, 0.3, 1.5}}, *hand, 2), Error);
  EXPECT_THROW(check_targets({{Variable::phi, 0, std::nan(""), 0.5}}, *hand, 2), Error);
}

TEST(OnlineOptions, NameWhatIsWrong) {
  const auto hand = testing::two_finger_hand();
  EXPECT_TRUE(OnlineOptions{}.validate(*hand).empty());
  OnlineOptions bad;
  bad.cone_half_angle = -1.0;
  bad.queue = 0;
  EXPECT_EQ(bad.validate(*hand).size(), 2u);
}

}  // namespace
}  // namespace eigengrasp
