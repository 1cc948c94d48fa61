// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/hand_check.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "unit/model_io_fixture.hpp"

namespace eigengrasp {
namespace {

using testing::cube_obj;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::small_urdf;
using testing::small_yaml;
using testing::TempFolder;

/// A hand without fault: the small one with its contacts on the surface.
HandModel sound_hand() {
  const TempFolder folder;
  folder.write("cube.obj", cube_obj(0.06));
  folder.write("gripper.urdf", small_urdf);
  folder.write("hand.yaml", small_yaml);
  HandModel hand = load_hand(folder.path());
  hand.virtual_contacts = {{2, Vec3(0.02, 0, -0.005), -Vec3::UnitZ()}, {0, Vec3(0, 0, 0.03), Vec3::UnitZ()}};
  return hand;
}

std::vector<std::string> findings(const std::function<void(HandModel&)>& spoil) {
  HandModel hand = sound_hand();
  spoil(hand);
  std::vector<std::string> lines;
  for (const HandFinding& f : check_hand(hand))
    lines.push_back(severity_name(f.severity) + ": " + f.sentence);
  return lines;
}

TEST(CheckHand, HasNothingToSayOfASoundHand) {
  EXPECT_THAT(findings([](HandModel&) {}), IsEmpty());
}

TEST(CheckHand, CollisionsInTheRestPosture) {
  EXPECT_THAT(findings([](HandModel& h) {
                h.joints[2].X_PJ.translation() = Vec3(0.075, 0, 0.03);
                h.dofs[0].rest = 0.01;
              }),
              ElementsAre(HasSubstr("error: the links proximal and thumb collide in the rest posture, ")));
}

TEST(CheckHand, Contacts) {
  EXPECT_THAT(findings([](HandModel& h) { h.virtual_contacts.clear(); }),
              ElementsAre(HasSubstr("error: the hand has no virtual contacts")));
  EXPECT_THAT(
      findings([](HandModel& h) { h.virtual_contacts[0].p_LC.z() = -0.009; }),
      ElementsAre(HasSubstr("warning: virtual contact 1 on distal at (0.02, 0, -0.009): is 4.0 mm off the "
                            "surface; move it to (0.02, 0, -0.005)")));
  EXPECT_THAT(
      findings([](HandModel& h) { h.virtual_contacts[1].n_LC *= -1.0; }),
      ElementsAre(HasSubstr("virtual contact 2 on palm at (0, 0, 0.03): its normal (-0, -0, -1) points into "
                            "the link; turn it round")));
  EXPECT_THAT(
      findings([](HandModel& h) {
        h.links[1].mesh = {};
        h.virtual_contacts[0].link = 1;
      }),
      ElementsAre(HasSubstr("error: virtual contact 1 on proximal at (0.02, 0, -0.005): the link has no "
                            "surface")));
}

TEST(CheckHand, Closing) {
  EXPECT_THAT(findings([](HandModel& h) { h.dofs[0].closing_speed = h.dofs[1].closing_speed = 0.0; }),
              ElementsAre(HasSubstr("error: no degree of freedom closes")));
}

TEST(CheckHand, Limits) {
  EXPECT_THAT(
      findings([](HandModel& h) {
        h.dofs[0].min = h.dofs[0].max = h.joints[2].min = h.joints[2].max = h.dofs[0].rest = 0.02;
        h.eigengrasps = EigengraspSpace(Eigen::Vector2d(0.02, 0.4), {{"close", VecX::Unit(2, 1), -1, 1}});
      }),
      ElementsAre(HasSubstr("warning: degree of freedom slide: its limits leave only the value 0.02, so it "
                            "cannot move")));
  EXPECT_THAT(
      findings([](HandModel& h) { h.dofs[1].min = 2.0; }),
      ::testing::Contains(HasSubstr("error: degree of freedom mcp: its limits 2 to 1.6 leave no value")));
  EXPECT_THAT(
      findings([](HandModel& h) { h.joints[1].max = 1.4; }),
      ElementsAre(HasSubstr("note: joint pip: its limits are 0 to 1.4, but its coupling to mcp lets it reach "
                            "only 0 to 0.9")));
  EXPECT_THAT(
      findings([](HandModel& h) { h.dofs[0].rest = 0.05; }),
      ElementsAre(HasSubstr("warning: degree of freedom slide: its rest value 0.05 is outside its limits")));
}

TEST(CheckHand, Eigengrasps) {
  EXPECT_THAT(
      findings([](HandModel& h) {
        h.eigengrasps = EigengraspSpace(Eigen::Vector2d(0, 2), {{"close", VecX::Unit(2, 1), -4, 4}});
      }),
      ElementsAre(HasSubstr("warning: eigengrasps: the origin of mcp is 2, outside its limits -0.2 to 1.6")));
  EXPECT_THAT(
      findings([](HandModel& h) {
        h.eigengrasps = EigengraspSpace(Eigen::Vector2d(0, 0.5), {{"close", VecX::Unit(2, 1), 1, 1}});
      }),
      ElementsAre(HasSubstr("warning: eigengrasp 1 (close): its amplitude range 1 to 1 moves no degree of "
                            "freedom")));
}

TEST(CheckHand, SizesAndMasses) {
  EXPECT_THAT(
      findings([](HandModel& h) { transform(h.links[0].mesh, Pose::Identity(), 1000.0); }),
      ::testing::Contains(HasSubstr("warning: the hand is 60 m large, expected less than 1 m; did you mean "
                                    "mm?")));
  EXPECT_THAT(
      findings([](HandModel& h) { h.links[0].mass = 500.0; }),
      ElementsAre(HasSubstr("warning: link palm: its mass is 500 kg, expected less than 5 kg; did you mean "
                            "g?")));
  EXPECT_THAT(findings([](HandModel& h) {
                for (HandLink& link : h.links) transform(link.mesh, Pose::Identity(), 1e-3);
                for (HandJoint& joint : h.joints) joint.X_PJ.translation() *= 1e-3;
                for (VirtualContact& c : h.virtual_contacts) c.p_LC *= 1e-3;
                h.dofs[0].rest = 0.0;
              }),
              ::testing::Contains(HasSubstr("mm large, expected more than 30 mm")));
  EXPECT_THAT(findings([](HandModel& h) {
                for (HandLink& link : h.links) link.mesh = {};
              }),
              ::testing::Contains(HasSubstr("error: no link has a surface")));
}

TEST(CheckHand, OpenAndTurnedMeshes) {
  EXPECT_THAT(
      findings([](HandModel& h) { h.links[0].mesh.triangles.pop_back(); }),
      ElementsAre(HasSubstr("note: link palm: its mesh is not closed (3 open edges, 0 edges of more than two "
                            "triangles)")));
  EXPECT_THAT(findings([](HandModel& h) {
                for (auto& t : h.links[0].mesh.triangles) std::swap(t[0], t[1]);
              }),
              ElementsAre(HasSubstr("warning: link palm: its mesh is inside out")));
}

TEST(CheckHand, WorstComesFirst) {
  const auto lines = findings([](HandModel& h) {
    h.links[0].mesh.triangles.pop_back();
    h.links[0].mass = 500.0;
    h.dofs[0].closing_speed = h.dofs[1].closing_speed = 0.0;
  });
  EXPECT_THAT(lines, ElementsAre(::testing::StartsWith("error"), ::testing::StartsWith("warning"),
                                 ::testing::StartsWith("note")));
}

}  // namespace
}  // namespace eigengrasp
