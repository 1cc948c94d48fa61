// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/kinematics_hand_builder.hpp"

namespace eigengrasp {
namespace {

using ::testing::HasSubstr;
using Pairs = std::vector<std::array<int, 2>>;

/// base - empty - proximal - (fixed) pad, base - thumb; all but "empty" have a triangle.
HandModel small_hand() {
  HandModel hand;
  TriangleMesh triangle;
  triangle.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  triangle.triangles = {{0, 1, 2}};
  for (const char* name : {"base", "empty", "proximal", "pad", "thumb"}) {
    hand.links.push_back({.name = name, .mesh = triangle, .material = {}, .mass = 0.0});
  }
  hand.links[1].mesh = {};
  hand.joints.resize(4);
  const int parents[] = {0, 1, 2, 0};
  for (int j = 0; j < 4; ++j) {
    hand.joints[static_cast<std::size_t>(j)].name = fmt::format("j{}", j);
    hand.joints[static_cast<std::size_t>(j)].parent_link = parents[j];
    hand.joints[static_cast<std::size_t>(j)].dof = 0;
  }
  hand.joints[2].type = JointType::fixed;
  hand.joints[2].dof = -1;
  hand.dofs = {{"d", DofType::rigid, -1, 1, 0, 1}};
  hand.frames = {{"tip", 3, Pose::Identity()}};
  hand.eigengrasps = EigengraspSpace(VecX::Zero(1), {});
  return hand;
}

TEST(HandModel, CollisionPairsLeaveOutNeighboursAndBodiesOfFixedJoints) {
  HandModel hand = small_hand();
  set_collision_pairs(hand, {});
  EXPECT_EQ(hand.collision_pairs, (Pairs{{2, 4}, {3, 4}}));
  set_collision_pairs(hand, {{4, 2}});
  EXPECT_EQ(hand.collision_pairs, (Pairs{{3, 4}}));
}

TEST(HandModel, LinksBeyondANeighbourAreTested) {
  HandModel hand = small_hand();
  hand.joints[2].type = JointType::revolute;
  hand.joints[2].dof = 0;
  set_collision_pairs(hand, {});
  EXPECT_EQ(hand.collision_pairs, (Pairs{{0, 3}, {2, 4}, {3, 4}}));
}

TEST(HandModel, FindsByName) {
  const HandModel hand = small_hand();
  EXPECT_EQ(hand.find_link("pad"), 3);
  EXPECT_EQ(hand.find_joint("j2"), 2);
  EXPECT_EQ(hand.find_frame("tip"), 0);
  EXPECT_EQ(hand.find_link("palm"), -1);
}

std::string broken(const std::function<void(HandModel&)>& spoil) {
  HandModel hand = small_hand();
  spoil(hand);
  try {
    check_invariants(hand);
  } catch (const std::logic_error& e) {
    return e.what();
  }
  return "sound";
}

TEST(HandModel, ChecksInvariants) {
  EXPECT_EQ(broken([](HandModel&) {}), "sound");
  EXPECT_EQ(broken([](HandModel& h) { h = testing::random_hand(1, 12); }), "sound");
  EXPECT_THAT(broken([](HandModel& h) { h.links.pop_back(); }), HasSubstr("one joint fewer"));
  EXPECT_THAT(broken([](HandModel& h) { h.joints[1].parent_link = 2; }), HasSubstr("stands after it"));
  EXPECT_THAT(broken([](HandModel& h) { h.joints[0].axis_J *= 2.0; }), HasSubstr("\"j0\"): its axis"));
  EXPECT_THAT(broken([](HandModel& h) { h.joints[0].dof = 1; }), HasSubstr("does not exist"));
  EXPECT_THAT(broken([](HandModel& h) { h.joints[0].X_PJ.linear() *= 2.0; }), HasSubstr("no rigid motion"));
  EXPECT_THAT(broken([](HandModel& h) { h.dofs[0].min = 2.0; }), HasSubstr("degree of freedom \"d\""));
  EXPECT_THAT(broken([](HandModel& h) { h.links[0].mesh.triangles[0][1] = 3; }),
              HasSubstr("beyond the vertices"));
  EXPECT_THAT(broken([](HandModel& h) { h.frames[0].link = 9; }), HasSubstr("frame \"tip\""));
  EXPECT_THAT(broken([](HandModel& h) {
                h.virtual_contacts = {{0, Vec3::Zero(), Vec3::Zero()}};
              }),
              HasSubstr("virtual contact"));
  EXPECT_THAT(broken([](HandModel& h) { h.collision_pairs = {{3, 2}}; }), HasSubstr("collision pair"));
  EXPECT_THAT(broken([](HandModel& h) { h.eigengrasps = {}; }), HasSubstr("eigengrasps"));
}

}  // namespace
}  // namespace eigengrasp
