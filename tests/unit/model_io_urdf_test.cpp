// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <numbers>

#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "unit/model_io_fixture.hpp"

namespace eigengrasp {
namespace {

using testing::cube_obj;
using ::testing::EndsWith;
using testing::error_of;
using ::testing::HasSubstr;
using testing::small_urdf;
using testing::TempFolder;
using testing::with;

HandModel load_text(const std::string& urdf) {
  const TempFolder folder;
  folder.write("cube.obj", cube_obj(0.06));
  return load_hand(folder.write("gripper.urdf", urdf));
}

TEST(UrdfHand, ReadsTreeLimitsAndCouplings) {
  const HandModel hand = load_text(small_urdf);
  ASSERT_EQ(hand.n_links(), 4);  // finger_tip is a frame
  EXPECT_EQ(hand.links[0].name, "palm");
  EXPECT_EQ(hand.links[2].name, "distal");
  EXPECT_EQ(hand.links[0].mass, 0.5);
  ASSERT_EQ(hand.n_dof(), 2);
  EXPECT_EQ(hand.dof_names(), (std::vector<std::string>{"mcp", "slide"}));
  const HandJoint& pip = hand.joints[1];
  EXPECT_EQ(pip.dof, 0);
  EXPECT_EQ(pip.ratio, 0.5);
  EXPECT_EQ(pip.offset, 0.1);
  EXPECT_EQ(hand.joints[0].axis_J, Vec3::UnitY());
  EXPECT_EQ(hand.joints[2].type, JointType::prismatic);
  EXPECT_NEAR(hand.dofs[0].min, -0.2, 1e-15);  // pip allows (0 - 0.1) / 0.5 = -0.2
  EXPECT_NEAR(hand.dofs[0].max, 1.6, 1e-15);   // and (0.9 - 0.1) / 0.5
  ASSERT_EQ(hand.frames.size(), 1u);
  EXPECT_EQ(hand.frames[0].name, "finger_tip");
  EXPECT_EQ(hand.frames[0].link, 2);
  EXPECT_EQ(hand.frames[0].X_LF.translation(), Vec3(0.035, 0, 0));
  EXPECT_EQ(hand.eigengrasps.size(), 2);
  EXPECT_EQ(hand.collision_pairs, (std::vector<std::array<int, 2>>{{0, 2}, {1, 3}, {2, 3}}));
}

TEST(UrdfHand, DofLimitsAreThoseOfTheirJointsTogether) {
  const HandModel hand = load_text(with(small_urdf, R"(upper="0.9")", R"(upper="0.4")"));
  EXPECT_NEAR(hand.dofs[0].max, 0.6, 1e-15);
  const HandModel back =
      load_text(with(small_urdf, R"(multiplier="0.5" offset="0.1")", R"(multiplier="-1")"));
  EXPECT_NEAR(back.dofs[0].min, -0.2, 1e-15);
  EXPECT_NEAR(back.dofs[0].max, 0.0, 1e-15);
}

TEST(UrdfHand, MeshesPrimitivesFinelyAndClosed) {
  const HandModel hand = load_text(small_urdf);
  const MeshReport palm = inspect_mesh(hand.links[0].mesh);
  EXPECT_TRUE(palm.solid());
  EXPECT_NEAR(palm.volume, 0.06 * 0.06 * 0.06, 1e-9);
  const MeshReport box = inspect_mesh(hand.links[1].mesh);
  EXPECT_TRUE(box.solid());
  EXPECT_NEAR(box.volume, 0.04 * 0.01 * 0.01, 1e-15);
  EXPECT_NEAR(box.volume_center.x(), 0.02, 1e-15);
  const MeshReport cylinder = inspect_mesh(hand.links[2].mesh);  // turned along x by its origin
  EXPECT_TRUE(cylinder.solid());
  EXPECT_NEAR(cylinder.volume / (std::numbers::pi * 0.005 * 0.005 * 0.03), 1.0, 2e-3);
  EXPECT_NEAR(cylinder.box.size().x(), 0.03, 1e-12);
  const MeshReport spheres = inspect_mesh(hand.links[3].mesh);
  EXPECT_TRUE(spheres.solid());
  EXPECT_EQ(spheres.components, 2);
  EXPECT_NEAR(spheres.volume / (2.0 * 4.0 / 3.0 * std::numbers::pi * 1e-6), 1.0, 5e-3);
}

TEST(UrdfHand, ScalesAndMirrorsMeshes) {
  const HandModel hand =
      load_text(with(small_urdf, R"(filename="cube.obj")", R"(filename="cube.obj" scale="1 -2 0.5")"));
  const MeshReport palm = inspect_mesh(hand.links[0].mesh);
  EXPECT_TRUE(palm.solid());  // the mirrored triangles were turned round
  EXPECT_LT((palm.box.size() - Vec3(0.06, 0.12, 0.03)).norm(), 1e-7);
}

TEST(UrdfHand, FindsMeshesOfPackages) {
  const TempFolder folder;
  folder.write("hands/cube.obj", cube_obj(0.06));
  const auto text = with(small_urdf, R"("cube.obj")", R"("package://hands/cube.obj")");
  EXPECT_FALSE(load_hand(folder.write("hands/urdf/gripper.urdf", text)).links[0].mesh.empty());
  EXPECT_FALSE(load_hand(folder.write("other/gripper.urdf", text)).links[0].mesh.empty());
  const auto absolute =
      with(small_urdf, R"("cube.obj")", "\"file://" + (folder.path() / "hands/cube.obj").string() + "\"");
  EXPECT_FALSE(load_hand(folder.write("gripper.urdf", absolute)).links[0].mesh.empty());
}

TEST(UrdfHand, LeavesMeshesOutWhenAsked) {
  const TempFolder folder;
  folder.write("cube.obj", "not a mesh");
  const HandModel hand = load_hand(folder.write("gripper.urdf", small_urdf), {.load_meshes = false});
  EXPECT_EQ(hand.n_links(), 4);
  for (const HandLink& link : hand.links) EXPECT_TRUE(link.mesh.empty());
}

TEST(UrdfHand, ContinuousJointsReachPi) {
  const HandModel hand =
      load_text(with(small_urdf, R"(name="mcp" type="revolute")", R"(name="mcp" type="continuous")"));
  EXPECT_EQ(hand.joints[0].max, std::numbers::pi);
  EXPECT_EQ(hand.joints[0].min, -std::numbers::pi);
}

TEST(UrdfHand, ResolvesMimicsOfMimics) {
  const std::string chain =
      with(small_urdf, R"(<limit lower="0" upper="0.03"/>)",
           R"(<limit lower="-1" upper="1"/><mimic joint="pip" multiplier="0.1" offset="0.02"/>)");
  const HandModel hand = load_text(chain);
  ASSERT_EQ(hand.n_dof(), 1);
  const VecX joints = joint_values(hand, VecX::Constant(1, 0.8));
  EXPECT_NEAR(joints[1], 0.5 * 0.8 + 0.1, 1e-15);
  EXPECT_NEAR(joints[2], 0.1 * (0.5 * 0.8 + 0.1) + 0.02, 1e-15);
}

TEST(UrdfHand, SaysWhatItAssumesOfABareUrdf) {
  const TempFolder folder;
  folder.write("cube.obj", cube_obj(0.06));
  std::vector<std::string> heard;
  load_hand(folder.write("gripper.urdf", small_urdf),
            {.log = [&](const std::string& sentence) { heard.push_back(sentence); }});
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_THAT(heard[0], HasSubstr("URDF without hand.yaml"));
}

struct BadUrdf {
  std::string from, to, expected;  ///< of the small URDF; what the sentence ends in
};

TEST(UrdfHand, EveryErrorNamesFileLineValueAndExpectation) {
  const std::vector<BadUrdf> cases = {
      {"</robot>", "", ":1: is not well-formed XML (XML_ERROR_PARSING)"},
      {R"(<link name="finger_tip"/>)", R"(<link name="thumb"/>)",
       ":13: the link \"thumb\" is there already, in line 12, expected another name"},
      {R"(<joint name="pip")", R"(<joint name="mcp")",
       ":22: the joint \"mcp\" is there already, in line 17, expected another name"},
      {R"(<link name="finger_tip"/>)", R"(<link/>)", ":12: <link> has no attribute name, expected one"},
      {R"(<mass value="0.5"/>)", R"(<mass value="heavy"/>)",
       ":4: <mass>: value is \"heavy\", expected a number"},
      {R"(<mass value="0.5"/>)", R"(<mass value="-1"/>)",
       ":4: <mass>: value is \"-1\", expected a positive number of kg"},
      {R"(xyz="0.05 0 0.03")", R"(xyz="0.05 0")", ":19: <origin>: xyz is \"0.05 0\", expected 3 numbers"},
      {R"(xyz="0.05 0 0.03")", R"(xyz="0.05 0 nan")",
       ":19: <origin>: xyz is \"0.05 0 nan\", expected 3 numbers"},
      {R"(<axis xyz="0 2 0"/>)", R"(<axis xyz="0 0 0"/>)",
       ":19: <axis> of joint mcp: xyz is \"0 0 0\", expected a direction that is not zero"},
      {R"(type="prismatic")", R"(type="planar")",
       ":32: joint slide: type is \"planar\", expected one of revolute, continuous, prismatic, fixed"},
      {R"(<limit lower="-0.2" upper="1.6"/>)", "", ":17: <joint> has no <limit>, expected one"},
      {R"(lower="-0.2" upper="1.6")", R"(lower="2" upper="1")",
       ":20: <limit> of joint mcp: lower is \"2\", expected at most upper, 1"},
      {R"(upper="0.9")", R"(upper="inf")", ":25: <limit>: upper is \"inf\", expected a number"},
      {R"(<child link="proximal"/>)", R"(<child link="proximl"/>)",
       ":17: joint mcp: the child link is \"proximl\", expected a link of the file (did you mean "
       "\"proximal\"?)"},
      {R"(<child link="distal"/>)", R"(<child link="proximal"/>)",
       ":22: joint pip: its child link \"proximal\" hangs on joint mcp already (line 17), expected one joint "
       "a link"},
      {R"(<parent link="palm"/><child link="thumb"/>)", R"(<parent link="thumb"/><child link="thumb"/>)",
       ":32: joint slide: is part of a cycle of joints that does not reach the root link \"palm\", expected "
       "a tree"},
      {R"(joint="mcp" multiplier)", R"(joint="mpc" multiplier)",
       ":22: joint pip: mimics \"mpc\", expected a joint of the file (did you mean \"mcp\"?)"},
      {R"(joint="mcp" multiplier)", R"(joint="tip" multiplier)",
       ":22: joint pip: mimics \"tip\", which is fixed, expected a joint that moves"},
      {R"(joint="mcp" multiplier)", R"(joint="pip" multiplier)",
       ":22: joint pip: mimics \"pip\", which comes back to itself, expected a joint that moves on its own"},
      {R"(multiplier="0.5")", R"(multiplier="0")",
       ":26: <mimic>: multiplier is \"0\", expected another number (or a joint of type fixed)"},
      {R"(lower="0" upper="0.9")", R"(lower="3" upper="4")",
       ":17: joint mcp: its limits and those of the joints that mimic it have no value in common, expected a "
       "range"},
      {R"("cube.obj")", R"("package://none/cube.obj")",
       ":3: <mesh>: filename is \"package://none/cube.obj\", but it is in no package \"none\" above "
       "gripper.urdf; "
       "write it relative to the URDF"},
      {R"("cube.obj")", R"("cube.obj" scale="1 0 1")",
       ":3: <mesh>: scale is \"1 0 1\", expected 3 numbers that are not 0"},
      {R"(<box size="0.04 0.01 0.01"/>)", R"(<box size="0.04 -0.01 0.01"/>)",
       ":7: <box>: size is \"0.04 -0.01 0.01\", expected 3 positive lengths [m]"},
      {R"(<cylinder radius="0.005")", R"(<cylinder radius="0")",
       ":10: <cylinder>: radius is \"0\", expected a positive length [m]"},
      {R"(<box size="0.04 0.01 0.01"/>)", R"(<cone size="1"/>)",
       ":7: <geometry> holds none of mesh, box, cylinder, sphere, expected one of them"},
  };
  for (const BadUrdf& bad : cases) {
    SCOPED_TRACE(bad.to);
    const std::string sentence = error_of([&] { load_text(with(small_urdf, bad.from, bad.to)); });
    EXPECT_THAT(sentence, HasSubstr("gripper.urdf:"));
    EXPECT_THAT(sentence, EndsWith(bad.expected));
  }
}

TEST(UrdfHand, RefusesMissingMeshesRootsAndCycles) {
  EXPECT_THAT(error_of([] { load_text(with(small_urdf, "cube.obj", "cub.obj")); }),
              ::testing::AllOf(HasSubstr("gripper.urdf:3: <mesh>: filename is \"cub.obj\", but "),
                               EndsWith("cub.obj does not exist")));
  const std::string lonely =
      with(small_urdf, R"(<link name="finger_tip"/>)", R"(<link name="finger_tip"/><link name="x"/>)");
  EXPECT_THAT(
      error_of([&] { load_text(lonely); }),
      HasSubstr("gripper.urdf:12: the links \"palm\" and \"x\" both have no joint above them, expected one "
                "root (join them with a joint of type fixed)"));
  EXPECT_THAT(
      error_of([] {
        load_text(R"(<robot name="r"><link name="a"/><link name="b"/>
<joint name="ab" type="fixed"><parent link="a"/><child link="b"/></joint>
<joint name="ba" type="fixed"><parent link="b"/><child link="a"/></joint></robot>)");
      }),
      EndsWith("gripper.urdf:2: every link has a joint above it, so the joints make a cycle, expected one "
               "root link"));
}

TEST(UrdfHand, RefusesWhatIsNoHand) {
  const TempFolder folder;
  EXPECT_THAT(error_of([&] { load_hand(folder.path() / "none"); }), HasSubstr("none: does not exist"));
  EXPECT_THAT(error_of([&] { load_hand(folder.path()); }), HasSubstr(": holds no hand.yaml, expected one"));
  EXPECT_THAT(error_of([&] { load_hand(folder.write("hand.obj", "v 0 0 0")); }),
              EndsWith("ends in \".obj\", expected a folder, or a file that ends in .yaml, .urdf or .xml"));
  EXPECT_THAT(error_of([&] { load_hand(folder.write("empty.urdf", "")); }),
              HasSubstr("empty.urdf: is not well-formed XML"));
  EXPECT_THAT(error_of([&] { load_hand(folder.write("world.urdf", "<world/>")); }),
              EndsWith("world.urdf:1: the outermost element is <world>, expected <robot>"));
  EXPECT_THAT(error_of([&] { load_hand(folder.write("bare.urdf", "<robot name=\"r\"/>")); }),
              EndsWith("bare.urdf:1: <robot> has no <link>, expected at least one"));
}

}  // namespace
}  // namespace eigengrasp
