// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// What waits for a test, and what is offered: against the rules that the headers state.
#include <gtest/gtest.h>

#include "eigengrasp/core/random.hpp"
#include "online/candidate_queue.hpp"
#include "online/solution_list.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

PreGrasp pregrasp(double x, double energy) {
  PreGrasp p;
  p.X_OH.translation().x() = x;
  p.dofs = VecX::Zero(2);
  p.energy = energy;
  return p;
}

TEST(CandidateQueue, GivesTheBestFirstAndDropsTheWorst) {
  CandidateQueue queue(2, {});
  EXPECT_TRUE(queue.add(pregrasp(0.0, 5.0)));
  EXPECT_TRUE(queue.add(pregrasp(0.1, -3.0)));
  EXPECT_TRUE(queue.add(pregrasp(0.2, 1.0)));
  EXPECT_FALSE(queue.add(pregrasp(0.3, 9.0)));
  EXPECT_EQ(queue.take()->energy, -3.0);
  EXPECT_EQ(queue.take()->energy, 1.0);
  EXPECT_FALSE(queue.take().has_value());
}

TEST(CandidateQueue, TestsThePlaceAgainOnlyForMuchBetter) {
  CandidateQueue queue(5, {});
  queue.add(pregrasp(0.0, 5.0));
  (void)queue.take();
  EXPECT_FALSE(queue.add(pregrasp(0.001, 4.0)));
  EXPECT_TRUE(queue.add(pregrasp(0.001, -6.0)));
  EXPECT_TRUE(queue.add(pregrasp(0.1, 4.0))) << "another place";
  queue.clear(true);
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.add(pregrasp(0.001, 4.0))) << "forgotten";
}

class SolutionListTest : public ::testing::Test {
 protected:
  SolutionListTest() : scene_(testing::ball_scene()), list_(scene_, options_) {}

  /// A grasp whose pre-grasp is `ahead` of the origin's wrist and turned by an angle about x.
  static Grasp grasp(double ahead, double angle, double epsilon) {
    Grasp g = testing::ball_grasp();
    g.X_OH_pregrasp = make_pose(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitX())), {0, 0, ahead});
    g.pregrasp_dofs = VecX::Zero(2);
    g.epsilon = epsilon;
    return g;
  }

  Scene scene_;
  OnlineOptions options_;
  SolutionList list_;
  Pose wrist_ = Pose::Identity();
};

TEST_F(SolutionListTest, OffersTheNearestToTheApproachThenTheStrongest) {
  list_.add(grasp(0.10, 0.45, 0.9), wrist_, 0.0);
  list_.add(grasp(0.05, 0.02, 0.1), wrist_, 0.0);
  list_.add(grasp(0.15, 0.03, 0.2), wrist_, 0.0);
  list_.update(wrist_, 0.0);
  ASSERT_NE(list_.offered(), nullptr);
  EXPECT_EQ(list_.offered()->epsilon, 0.2);
  const auto all = list_.list(wrist_, 1.0);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].epsilon, 0.2);
  EXPECT_EQ(all[2].epsilon, 0.9);
  EXPECT_NEAR(all[0].distance, 0.15, 1e-3);
  EXPECT_EQ(all[0].age, 1.0);
}

TEST_F(SolutionListTest, DoesNotFlickerUnderTremor) {
  list_.add(grasp(0.10, 0.10, 0.20), wrist_, 0.0);
  list_.add(grasp(0.10, -0.10, 0.21), wrist_, 0.0);
  list_.add(grasp(0.12, 0.165, 0.22), wrist_, 0.0);
  RandomStream random{1};
  int changes = 0;
  double last = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Pose shaken =
        make_pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.03 * random.normal(), Vec3::UnitX())), Vec3::Zero());
    list_.update(shaken, 0.01 * i);
    ASSERT_NE(list_.offered(), nullptr);
    changes += i > 0 && list_.offered()->epsilon != last;
    last = list_.offered()->epsilon;
  }
  EXPECT_LE(changes, 2);
}

TEST_F(SolutionListTest, FollowsAClearChangeOfDirection) {
  list_.add(grasp(0.10, -0.3, 0.2), wrist_, 0.0);
  list_.add(grasp(0.10, 0.3, 0.2), wrist_, 0.0);
  const auto turned = [](double a) {
    return make_pose(Eigen::Quaterniond(Eigen::AngleAxisd(a, Vec3::UnitX())), Vec3::Zero());
  };
  list_.update(turned(-0.2), 0.0);
  const std::uint64_t first = list_.list(wrist_, 0.0)[0].id;
  list_.update(turned(0.2), 0.2);
  EXPECT_EQ(list_.list(wrist_, 0.0)[0].id, first) << "changed a moment ago";
  list_.update(turned(0.2), 0.6);
  EXPECT_NE(list_.list(wrist_, 0.0)[0].id, first);
}

TEST_F(SolutionListTest, DropsWhatTheWristHasLeftBehind) {
  list_.add(grasp(0.10, 0.0, 0.2), wrist_, 0.0);
  list_.update(wrist_, 0.0);
  EXPECT_TRUE(list_.any_in_reach(wrist_));
  const Pose elsewhere = make_pose(Eigen::Quaterniond(0, 1, 0, 0), Vec3(0.3, 0.0, 0.0));
  list_.update(elsewhere, 0.5);
  EXPECT_EQ(list_.offered(), nullptr);
  EXPECT_EQ(list_.list(elsewhere, 0.5).size(), 1u) << "kept for a while: the operator may come back";
  list_.update(elsewhere, 3.0);
  EXPECT_TRUE(list_.list(elsewhere, 3.0).empty());
}

TEST_F(SolutionListTest, KeepsNoMoreThanItMayAndTheOfferedOneAlways) {
  options_.solutions = 3;
  list_.add(grasp(0.02, 0.5, 0.5), wrist_, 0.0);
  list_.update(wrist_, 0.0);
  const std::uint64_t offered = list_.list(wrist_, 0.0)[0].id;
  for (int i = 0; i < 6; ++i) list_.add(grasp(0.04 + 0.02 * i, 0.0, 0.1), wrist_, 0.1);
  EXPECT_EQ(list_.list(wrist_, 0.1).size(), 3u);
  EXPECT_EQ(list_.list(wrist_, 0.1)[0].id, offered);
  EXPECT_NE(list_.find(offered), nullptr);
}

TEST_F(SolutionListTest, OfTwoThatAreAlikeTheStrongerStays) {
  list_.add(grasp(0.10, 0.0, 0.2), wrist_, 0.0);
  list_.add(grasp(0.101, 0.01, 0.3), wrist_, 0.0);
  list_.add(grasp(0.101, 0.01, 0.1), wrist_, 0.0);
  const auto all = list_.list(wrist_, 0.0);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].epsilon, 0.3);
}

}  // namespace
}  // namespace eigengrasp
