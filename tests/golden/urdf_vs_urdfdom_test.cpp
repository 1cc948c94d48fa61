// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Our reader against urdfdom on hands that others made: same links, limits, couplings and poses.
#include <gtest/gtest.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "support/test_data.hpp"

namespace eigengrasp {
namespace {

Vec3 as_vec3(const urdf::Vector3& v) {
  return Vec3(v.x, v.y, v.z);
}

Pose as_pose(const urdf::Pose& pose) {
  double x = 0, y = 0, z = 0, w = 1;
  pose.rotation.getQuaternion(x, y, z, w);
  return make_pose(Eigen::Quaterniond(w, x, y, z), as_vec3(pose.position));
}

/// Value of a joint by its own coupling; all of these hands mimic joints that move on their own.
double value_of(const urdf::Joint& joint, const HandModel& hand, const VecX& posture) {
  const std::string& driver = joint.mimic ? joint.mimic->joint_name : joint.name;
  for (int d = 0; d < hand.n_dof(); ++d) {
    if (hand.dofs[static_cast<std::size_t>(d)].name != driver) continue;
    return joint.mimic ? joint.mimic->multiplier * posture[d] + joint.mimic->offset : posture[d];
  }
  ADD_FAILURE() << "no degree of freedom for " << joint.name;
  return 0.0;
}

Pose pose_of(const urdf::Link& link, const HandModel& hand, const VecX& posture) {
  if (!link.parent_joint) return Pose::Identity();
  const urdf::Joint& joint = *link.parent_joint;
  Pose X = pose_of(*link.getParent(), hand, posture) * as_pose(joint.parent_to_joint_origin_transform);
  if (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS) {
    X = X * Eigen::AngleAxisd(value_of(joint, hand, posture), as_vec3(joint.axis).normalized());
  } else if (joint.type == urdf::Joint::PRISMATIC) {
    X = X * Eigen::Translation3d(value_of(joint, hand, posture) * as_vec3(joint.axis).normalized());
  }
  return X;
}

void expect_same_joints(const HandModel& hand, const urdf::ModelInterface& oracle) {
  int movable = 0;
  for (const auto& [name, joint] : oracle.joints_) {
    if (joint->type == urdf::Joint::FIXED) continue;
    ++movable;
    const int j = hand.find_joint(name);
    ASSERT_GE(j, 0) << name;
    const HandJoint& ours = hand.joints[static_cast<std::size_t>(j)];
    EXPECT_EQ(hand.links[static_cast<std::size_t>(j + 1)].name, joint->child_link_name);
    if (joint->type != urdf::Joint::CONTINUOUS) {
      EXPECT_EQ(ours.min, joint->limits->lower) << name;
      EXPECT_EQ(ours.max, joint->limits->upper) << name;
    }
    EXPECT_EQ(ours.ratio, joint->mimic ? joint->mimic->multiplier : 1.0) << name;
    EXPECT_EQ(ours.offset, joint->mimic ? joint->mimic->offset : 0.0) << name;
  }
  int ours = 0;
  for (const HandJoint& joint : hand.joints) ours += joint.type != JointType::fixed;
  EXPECT_EQ(ours, movable);
}

void expect_same_poses(const HandModel& hand, const urdf::ModelInterface& oracle) {
  RandomStream random{5};
  std::vector<Pose> X;
  for (int k = 0; k < 20; ++k) {
    VecX posture(hand.n_dof());
    for (int d = 0; d < hand.n_dof(); ++d) posture[d] = random.uniform(hand.dof_min()[d], hand.dof_max()[d]);
    compute_link_poses(hand, joint_values(hand, posture), Pose::Identity(), X);
    for (const auto& [name, link] : oracle.links_) {
      const int l = hand.find_link(name), f = hand.find_frame(name);
      ASSERT_TRUE((l >= 0) != (f >= 0)) << name;
      Pose ours = Pose::Identity();
      if (l >= 0) {
        ours = X[static_cast<std::size_t>(l)];
      } else {
        const HandFrame& frame = hand.frames[static_cast<std::size_t>(f)];
        ours = X[static_cast<std::size_t>(frame.link)] * frame.X_LF;
      }
      EXPECT_LT((ours.matrix() - pose_of(*link, hand, posture).matrix()).norm(), 1e-9) << name;
    }
  }
}

class UrdfVsUrdfdom : public ::testing::TestWithParam<const char*> {};

TEST_P(UrdfVsUrdfdom, SameTreeLimitsMimicsAndPoses) {
  const auto file = testing::test_data(std::filesystem::path("hands") / GetParam());
  EIGENGRASP_REQUIRE_DATA(file);
  const auto oracle = urdf::parseURDF(read_text_file(file));
  ASSERT_TRUE(oracle);
  const HandModel hand = load_hand(file);
  EXPECT_EQ(hand.name, oracle->getName());
  EXPECT_EQ(hand.links[0].name, oracle->getRoot()->name);
  EXPECT_EQ(hand.links.size() + hand.frames.size(), oracle->links_.size());
  expect_same_joints(hand, *oracle);
  expect_same_poses(hand, *oracle);
  for (const HandLink& link : hand.links) {
    const urdf::Link& theirs = *oracle->getLink(link.name);
    EXPECT_EQ(link.mesh.empty(), theirs.collision_array.empty() && theirs.visual_array.empty()) << link.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Hands, UrdfVsUrdfdom,
                         ::testing::Values("allegro_hand/allegro_hand_left.urdf",
                                           "allegro_hand/allegro_hand_right.urdf",
                                           "barrett_hand/bhand_model.urdf",
                                           "ability_hand/ability_hand_left.urdf",
                                           "ability_hand/ability_hand_right.urdf"));

}  // namespace
}  // namespace eigengrasp
