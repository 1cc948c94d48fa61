// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The hands of data/hands move like the robots of GraspIt! that they model: every link, and every fingertip.
// graspit_links.yaml beside each hand says which link is which and where its frame is.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <iostream>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/hand_check.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "support/graspit_reference.hpp"

namespace eigengrasp {
namespace {

struct ShippedHand {
  const char* name;
  const char* graspit_robot;
};

void PrintTo(const ShippedHand& hand, std::ostream* out) {
  *out << hand.name;
}

/// A link of ours, a link of GraspIt!, and the pose of GraspIt!'s frame in ours.
struct LinkPair {
  int ours = 0;
  HandFrame theirs;
  Pose X_LG = Pose::Identity();
};

Vec3 vector_of(const YAML::Node& node) {
  return Vec3(node[0].as<double>(), node[1].as<double>(), node[2].as<double>());
}

std::vector<LinkPair> read_pairs(const std::filesystem::path& file, const HandModel& ours,
                                 const HandModel& theirs) {
  std::vector<LinkPair> pairs;
  for (const YAML::Node& item : YAML::LoadFile(file)) {
    LinkPair pair;
    pair.ours = ours.find_link(item["link"].as<std::string>());
    EXPECT_GE(pair.ours, 0) << item["link"];
    const auto graspit_link = item["graspit_link"].as<std::string>();
    if (graspit_link != "palm") {
      const int frame = theirs.find_frame(graspit_link);
      EXPECT_GE(frame, 0) << graspit_link;
      if (frame < 0) continue;
      pair.theirs = theirs.frames[static_cast<std::size_t>(frame)];
    }
    const Vec3 rpy = vector_of(item["X"]["rpy"]);
    pair.X_LG = Pose(Eigen::Translation3d(vector_of(item["X"]["xyz"]))) *
                Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
                Eigen::AngleAxisd(rpy.x(), Vec3::UnitX());
    pairs.push_back(pair);
  }
  return pairs;
}

/// Tips against the frames of the last links of GraspIt!'s chains.
std::vector<LinkPair> pair_tips(const HandModel& ours, const std::vector<LinkPair>& links) {
  std::vector<LinkPair> tips;
  for (const HandFrame& frame : ours.frames) {
    if (!frame.name.ends_with("_tip")) continue;
    const auto pair =
        std::find_if(links.begin(), links.end(), [&](const LinkPair& p) { return p.ours == frame.link; });
    EXPECT_NE(pair, links.end()) << frame.name;
    if (pair != links.end()) tips.push_back({frame.link, pair->theirs, frame.X_LF});
  }
  return tips;
}

class ShippedHands : public ::testing::TestWithParam<ShippedHand> {};

TEST_P(ShippedHands, MoveLikeGraspits) {
  const auto robot =
      testing::test_data(std::filesystem::path("graspit/models/robots") / GetParam().graspit_robot);
  EIGENGRASP_REQUIRE_DATA(robot);
  const auto folder = testing::source_path("data/hands") / GetParam().name;
  const HandModel ours = load_hand(folder, {.load_meshes = false});
  const HandModel theirs = load_hand(robot, {.load_meshes = false});
  ASSERT_EQ(ours.n_dof(), theirs.n_dof());
  EXPECT_LT((ours.dof_min() - theirs.dof_min()).cwiseAbs().maxCoeff(), 1e-3) << ours.dof_min().transpose();
  EXPECT_LT((ours.dof_max() - theirs.dof_max()).cwiseAbs().maxCoeff(), 1e-3) << ours.dof_max().transpose();
  const auto links = read_pairs(folder / "graspit_links.yaml", ours, theirs);
  const auto tips = pair_tips(ours, links);
  EXPECT_GE(tips.size(), 3u);
  RandomStream random{1};
  std::vector<Pose> X, Y;
  double link_residual = 0.0, tip_residual = 0.0;
  for (int k = 0; k < 1000; ++k) {
    VecX posture(ours.n_dof());
    for (int d = 0; d < ours.n_dof(); ++d)
      posture[d] = random.uniform(theirs.dof_min()[d], theirs.dof_max()[d]);
    compute_link_poses(ours, joint_values(ours, posture), Pose::Identity(), X);
    compute_link_poses(theirs, joint_values(theirs, posture), Pose::Identity(), Y);
    for (const LinkPair& pair : links) {
      const Pose A = X[static_cast<std::size_t>(pair.ours)] * pair.X_LG;
      const Pose B = Y[static_cast<std::size_t>(pair.theirs.link)] * pair.theirs.X_LF;
      link_residual = std::max(link_residual, (A.translation() - B.translation()).norm());
      EXPECT_LT(angle_between(A.linear(), B.linear()), 1e-3);
    }
    for (const LinkPair& tip : tips) {
      const Vec3 a = X[static_cast<std::size_t>(tip.ours)] * tip.X_LG.translation();
      const Vec3 b = Y[static_cast<std::size_t>(tip.theirs.link)] * tip.theirs.X_LF.translation();
      tip_residual = std::max(tip_residual, (a - b).norm());
    }
  }
  std::cout << GetParam().name << ": links within " << 1e3 * link_residual << " mm, tips within "
            << 1e3 * tip_residual << " mm\n";
  EXPECT_LT(link_residual, 0.1e-3);
  EXPECT_LT(tip_residual, 0.1e-3);
}

TEST_P(ShippedHands, PassTheCheck) {
  const HandModel hand = load_hand(testing::source_path("data/hands") / GetParam().name);
  for (const HandFinding& finding : check_hand(hand)) {
    if (finding.severity == HandFinding::Severity::note) continue;
    ADD_FAILURE() << severity_name(finding.severity) << ": " << finding.sentence;
  }
}

INSTANTIATE_TEST_SUITE_P(Hands, ShippedHands,
                         ::testing::Values(ShippedHand{"barrett-metal", "Barrett/Barrett.xml"},
                                           ShippedHand{"barrett-rubber", "Barrett/Barrett.xml"},
                                           ShippedHand{"dlr", "DLR/DLR.xml"},
                                           ShippedHand{"robonaut", "Robonaut/Robonaut.xml"},
                                           ShippedHand{"human", "HumanHand/HumanHand20DOF.xml"}));

}  // namespace
}  // namespace eigengrasp
