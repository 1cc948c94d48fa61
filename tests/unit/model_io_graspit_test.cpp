// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "unit/model_io_fixture.hpp"

namespace eigengrasp {
namespace {

using ::testing::EndsWith;
using testing::error_of;
using ::testing::HasSubstr;
using testing::TempFolder;
using testing::with;

const std::string robot_xml = R"(<?xml version="1.0" ?>
<robot type="Hand">
  <palm>palm.xml</palm>
  <dof type="r"><defaultVelocity>0.0</defaultVelocity></dof>
  <dof type="b"><defaultVelocity>1.5</defaultVelocity></dof>
  <dof type="c"><defaultVelocity>-1.0</defaultVelocity></dof>
  <chain>
    <transform>
      <translation>40 0 0</translation>
      <rotation>90 x</rotation>
    </transform>
    <joint type="Revolute">
      <theta>d0+90</theta><d>0</d><a>0</a><alpha>-90</alpha><minValue>-20</minValue><maxValue>70</maxValue>
    </joint>
    <joint type="Revolute">
      <theta>d1</theta><d>5</d><a>50</a><alpha>90</alpha><minValue>0</minValue><maxValue>90</maxValue>
    </joint>
    <joint type="Revolute">
      <theta>d1*0.5+-10</theta><d>0</d><a>30</a><alpha>0</alpha><minValue>0</minValue><maxValue>30</maxValue>
    </joint>
    <link dynamicJointType="Universal">link.xml</link>
    <link dynamicJointType="Revolute">link.xml</link>
    <link dynamicJointType="Fixed">link.xml</link>
  </chain>
  <chain>
    <transform>
      <translation>-60 0 0</translation>
      <rotationMatrix>0 1 0 -1 0 0 0 0 1</rotationMatrix>
    </transform>
    <joint type="Prismatic">
      <theta>90</theta><d>d2*2+10</d><a>3</a><alpha>0</alpha><minValue>0</minValue><maxValue>40</maxValue>
    </joint>
    <link dynamicJointType="Prismatic">link.xml</link>
  </chain>
  <eigenGrasps>eigen.xml</eigenGrasps>
  <virtualContacts>contacts.xml</virtualContacts>
</robot>
)";

const std::string body_xml = R"(<?xml version="1.0" ?>
<root>
  <material>rubber</material>
  <youngs>1500000</youngs>
  <mass>150</mass>
  <cog>1 2 3</cog>
  <geometryFile type="Inventor">box.iv</geometryFile>
</root>
)";

const std::string eigen_xml = R"(<?xml version="1.0" ?>
<EigenGrasps dimensions="3">
  <EG>
    <Limits min="-1.5" max="2"/>
    <DimVals d0="3" d1="4"/>
  </EG>
  <EG><DimVals d2="1"/></EG>
  <ORIGIN><DimVals d1="0.25"/></ORIGIN>
</EigenGrasps>
)";

const std::string contacts_xml = R"(<?xml version="1.0" ?>
<virtual_contacts>
  <num_contacts>2</num_contacts>
  <virtual_contact>
    <finger_number>-1</finger_number>
    <link_number>0</link_number>
    <location>0 0 10</location>
    <normal>0 0 2</normal>
  </virtual_contact>
  <virtual_contact>
    <finger_number>0</finger_number>
    <link_number>1</link_number>
    <location>-5 1 2</location>
    <normal>0 1 0</normal>
  </virtual_contact>
</virtual_contacts>
)";

const std::string box_iv = "#Inventor V2.0 ascii\nSeparator { Cube { width 20 height 10 depth 10 } }\n";

class GraspitFolder : public TempFolder {
 public:
  GraspitFolder() {
    write("robot.xml", robot_xml);
    write("eigen.xml", eigen_xml);
    write("contacts.xml", contacts_xml);
    write("iv/palm.xml", with(body_xml, "<youngs>1500000</youngs>", ""));
    write("iv/link.xml", body_xml);
    write("iv/box.iv", box_iv);
  }
  HandModel load(const HandReadOptions& options = {}) const {
    return load_hand(path() / "robot.xml", options);
  }
};

constexpr double degree = 0.017453292519943295;

Pose rotate(double degrees, const Vec3& axis) {
  return Pose(Eigen::AngleAxisd(degrees * degree, axis));
}
Pose shift(double x, double y, double z) {
  return Pose(Eigen::Translation3d(1e-3 * x, 1e-3 * y, 1e-3 * z));
}
/// By Denavit and Hartenberg, in degrees and mm.
Pose dh(double theta, double d, double a, double alpha) {
  return rotate(theta, Vec3::UnitZ()) * shift(a, 0, d) * rotate(alpha, Vec3::UnitX());
}

TEST(GraspitRobot, ReadsDofsLinksAndMaterials) {
  const GraspitFolder folder;
  std::string heard;
  const HandModel hand = folder.load({.log = [&](const std::string& s) { heard += s + "\n"; }});
  ASSERT_EQ(hand.n_dof(), 3);
  EXPECT_EQ(hand.dofs[0].type, DofType::rigid);
  EXPECT_EQ(hand.dofs[1].type, DofType::breakaway);
  EXPECT_EQ(hand.dofs[2].type, DofType::breakaway);
  EXPECT_THAT(heard, HasSubstr("robot.xml:6: d2 is compliant; it closes like a break-away one"));
  EXPECT_THAT(heard, HasSubstr("has no <approachDirection>; the hand comes along the palm's z axis"));
  EXPECT_EQ(hand.dofs[1].closing_speed, 1.5);
  EXPECT_EQ(hand.dofs[1].rest, 0.0);
  EXPECT_NEAR(hand.dofs[1].max, 60 * degree, 1e-15);  // 30 / 0.5 is less than 90
  EXPECT_NEAR(hand.dofs[2].max, 0.02, 1e-15);         // 40 mm / 2
  EXPECT_EQ(hand.links[0].name, "palm");
  EXPECT_EQ(hand.links[0].material.name, "rubber");
  EXPECT_FALSE(hand.links[0].material.youngs_modulus.has_value());
  const int link = hand.find_link("chain0_link1");
  ASSERT_GE(link, 0);
  EXPECT_EQ(hand.links[static_cast<std::size_t>(link)].material.youngs_modulus, 1.5e6);
  EXPECT_EQ(hand.links[static_cast<std::size_t>(link)].mass, 0.15);
  EXPECT_TRUE(hand.links[static_cast<std::size_t>(hand.find_link("chain0_link0_axis0"))].mesh.empty());
  EXPECT_GE(hand.find_joint("chain0_joint2"), 0);
  EXPECT_GE(hand.find_link("chain0_link2"), 0);
}

TEST(GraspitRobot, FramesFollowDenavitAndHartenberg) {
  const GraspitFolder folder;
  const HandModel hand = folder.load();
  const VecX posture = Vec3(0.3, 0.5, 0.01);
  std::vector<Pose> X;
  compute_link_poses(hand, joint_values(hand, posture), Pose::Identity(), X);
  const auto frame = [&](const char* name) {
    const HandFrame& f = hand.frames[static_cast<std::size_t>(hand.find_frame(name))];
    return X[static_cast<std::size_t>(f.link)] * f.X_LF;
  };
  const Pose base = shift(40, 0, 0) * rotate(90, Vec3::UnitX());
  const Pose first = base * dh(0.3 / degree + 90, 0, 0, -90) * dh(0.5 / degree, 5, 50, 90);
  const Pose second = first * dh(0.25 / degree - 10, 0, 30, 0);
  EXPECT_LT((frame("chain0_link0").matrix() - first.matrix()).norm(), 1e-12);
  EXPECT_LT((frame("chain0_link1").matrix() - second.matrix()).norm(), 1e-12);
  EXPECT_LT((frame("chain0_link2").matrix() - second.matrix()).norm(), 1e-12);  // fixed to the one before
  Pose thumb = shift(-60, 0, 0) * rotate(-90, Vec3::UnitZ());  // a matrix is written by columns
  EXPECT_GT((thumb.linear() - rotate(90, Vec3::UnitZ()).linear()).norm(), 1.0);
  thumb = shift(-60, 0, 0) * rotate(90, Vec3::UnitZ()) * dh(90, 2 * 10 + 10, 3, 0);
  EXPECT_LT((frame("chain1_link0").matrix() - thumb.matrix()).norm(), 1e-12);
  // Meshes and contacts sit in our frames where GraspIt! has them in its own.
  const auto l = static_cast<std::size_t>(hand.find_link("chain0_link1"));
  const Vec3 center = inspect_mesh(hand.links[l].mesh).volume_center;
  EXPECT_LT((X[l] * center - second.translation()).norm(), 1e-7);
  const VirtualContact& c = hand.virtual_contacts[1];
  EXPECT_LT((X[l] * c.p_LC - second * Vec3(-0.005, 0.001, 0.002)).norm(), 1e-12);
  EXPECT_LT((X[l].linear() * c.n_LC - second.linear() * Vec3::UnitY()).norm(), 1e-12);
  EXPECT_EQ(hand.virtual_contacts[0].link, 0);
}

TEST(GraspitRobot, ReadsEigengraspsOrReplacesThem) {
  const GraspitFolder folder;
  const HandModel hand = folder.load();
  ASSERT_EQ(hand.eigengrasps.size(), 2);
  EXPECT_LT((hand.eigengrasps[0].direction - Vec3(0.6, 0.8, 0)).norm(), 1e-15);
  EXPECT_EQ(hand.eigengrasps[0].min, -1.5);
  EXPECT_EQ(hand.eigengrasps[1].max, 4.0);
  EXPECT_EQ(hand.eigengrasps.origin(), Vec3(0, 0.25, 0));
  HandReadOptions options;
  options.graspit_eigengrasp_file = folder.write("other.xml", with(eigen_xml, "d2=\"1\"", "d1=\"1\""));
  options.graspit_contact_files = {folder.path() / "contacts.xml", folder.path() / "contacts.xml"};
  const HandModel other = folder.load(options);
  EXPECT_LT((other.eigengrasps[1].direction - Vec3(-0.8, 0.6, 0)).norm(), 1e-15);
  EXPECT_EQ(other.virtual_contacts.size(), 4u);
}

TEST(GraspitRobot, CollisionPairsFollowItsRules) {
  const GraspitFolder folder;
  const HandModel hand = folder.load();
  const int thumb = hand.find_link("chain1_link0");
  for (const auto& [a, b] : hand.collision_pairs) {
    EXPECT_FALSE(a == 0 && hand.links[static_cast<std::size_t>(b)].name == "chain0_link0");
    EXPECT_TRUE(a == 0 || b == thumb) << "links of one chain";
    EXPECT_NE(std::make_pair(a, b), std::make_pair(0, thumb));
  }
  EXPECT_EQ(hand.collision_pairs.size(), 5u);  // palm with two links of chain 0, the thumb with its three
}

struct BadFile {
  std::string file, from, to, expected;
};

TEST(GraspitRobot, EveryErrorNamesFileLineValueAndExpectation) {
  const std::vector<BadFile> cases = {
      {"robot.xml", "<palm>palm.xml</palm>", "<palm></palm>",
       "robot.xml:3: <palm> is empty, expected a value"},
      {"robot.xml", R"(<dof type="r">)", R"(<dof type="q">)",
       "robot.xml:4: <dof>: type is \"q\", expected r (rigid), b (break-away) or c (compliant)"},
      {"robot.xml", "1.5</defaultVelocity>", "quick</defaultVelocity>",
       "robot.xml:5: <defaultVelocity> is \"quick\", expected a number"},
      {"robot.xml", "<translation>40 0 0</translation>", "<translation>40 0</translation>",
       "robot.xml:9: <translation> is \"40 0\", expected 3 numbers"},
      {"robot.xml", "90 x", "90 w",
       "robot.xml:10: <rotation> is \"90 w\", expected degrees and an axis such as \"90 x\""},
      {"robot.xml", "0 1 0 -1 0 0 0 0 1", "1 1 0 -1 0 0 0 0 1",
       "<rotationMatrix> is \"1 1 0 -1 0 0 0 0 1\", expected the 9 numbers of a rotation by columns"},
      {"robot.xml", "<translation>40 0 0</translation>", "<move>40 0 0</move>",
       "robot.xml:9: <move> in a <transform>, expected one of translation, rotation, rotationMatrix, "
       "fullTransform"},
      {"robot.xml", "d1*0.5+-10", "d1*0.5-10",
       "robot.xml:19: <theta> is \"d1*0.5-10\", expected dN, dN*ratio, dN+offset or dN*ratio+offset (a "
       "negative offset "
       "is written +-5)"},
      {"robot.xml", "d1*0.5+-10", "d1*0",
       "robot.xml:19: <theta> is \"d1*0\", expected a ratio that is not 0"},
      {"robot.xml", "d0+90", "d3+90",
       "robot.xml:12: <joint> is driven by d3, but the robot has 3 <dof>, expected d0 to d2"},
      {"robot.xml", "d0+90", "90",
       "robot.xml:12: <joint> has <theta> \"90\" and <d> \"0\", expected a degree of freedom such as d0 in "
       "one of them"},
      {"robot.xml", "d0+90", "d1+90", "robot.xml:4: d0 drives no joint, expected one that names it"},
      {"robot.xml", "d2*2+10", "d1*2+10",
       "robot.xml:5: d1 drives joints that turn and joints that slide, expected one kind"},
      {"robot.xml", "<minValue>-20</minValue>", "<minValue>80</minValue>",
       "robot.xml:13: <minValue> is \"80\", expected at most the <maxValue> 70"},
      {"robot.xml", "<minValue>-20</minValue>", "", "robot.xml:12: <joint> has no <minValue>, expected one"},
      {"robot.xml", "<minValue>0</minValue><maxValue>90</maxValue>",
       "<minValue>70</minValue><maxValue>90</maxValue>",
       "robot.xml:5: the limits of the joints of d1 have no value in common, expected a range"},
      {"robot.xml", "\"Universal\"", "\"Hooke\"",
       "<link>: dynamicJointType is \"Hooke\", expected one of Revolute, Prismatic, Universal, Ball, Fixed"},
      {"robot.xml", "\"Universal\"", "\"Ball\"",
       "<link> is moved by 1 more joints, but the chain has only 3 <joint> in all"},
      {"robot.xml", "\"Universal\"", "\"Revolute\"",
       "<joint> moves no link: the chain has 3 joints, but its links use 2"},
      {"eigen.xml", "dimensions=\"3\"", "dimensions=\"4\"",
       "eigen.xml:2: dimensions is \"4\", expected 3, the number of degrees of freedom of robot"},
      {"eigen.xml", "d1=\"4\"", "d7=\"4\"",
       "eigen.xml:5: <DimVals> names \"d7\", expected d0 to d2, one a degree of freedom of robot"},
      {"eigen.xml", "d1=\"4\"", "d1=\"x\"", "eigen.xml:5: <DimVals>: d1 is \"x\", expected a number"},
      {"eigen.xml", "min=\"-1.5\"", "min=\"3\"",
       "eigen.xml:4: <Limits>: min is \"3\", expected at most max, 2"},
      {"eigen.xml", "d2=\"1\"", "d2=\"0\"",
       "eigen.xml:2: eigengrasp 2 (\"eigengrasp 2\"): the direction is zero, expected a direction with a "
       "length"},
      {"contacts.xml", "<num_contacts>2", "<num_contacts>3",
       "contacts.xml:3: <num_contacts> is \"3\", but the file holds 2, expected as many"},
      {"contacts.xml", "<finger_number>0", "<finger_number>2",
       "contacts.xml:11: <finger_number> is \"2\", expected -1 (the palm) to 1"},
      {"contacts.xml", "<link_number>1", "<link_number>9",
       "contacts.xml:12: <link_number> is \"9\", expected 0 to 2"},
      {"contacts.xml", "<normal>0 1 0", "<normal>0 0 0",
       "contacts.xml:14: <normal> is \"0 0 0\", expected a direction that is not zero"},
      {"iv/link.xml", "<mass>150", "<mass>much", "link.xml:5: <mass> is \"much\", expected a number"},
      {"iv/link.xml", "<youngs>1500000", "<youngs>0",
       "link.xml:4: <youngs> is \"0\", expected a positive number of Pa"},
      {"iv/link.xml", "<root>", "<body>", ""},
  };
  for (const BadFile& bad : cases) {
    SCOPED_TRACE(bad.to);
    const GraspitFolder folder;
    folder.write(bad.file, with(read_text_file(folder.path() / bad.file), bad.from, bad.to));
    EXPECT_THAT(error_of([&] { folder.load(); }),
                ::testing::AllOf(HasSubstr(".xml:"), EndsWith(bad.expected)));
  }
}

TEST(GraspitRobot, RefusesMissingFiles) {
  for (const char* file : {"eigen.xml", "contacts.xml", "iv/palm.xml", "iv/link.xml", "iv/box.iv"}) {
    const GraspitFolder folder;
    std::filesystem::remove(folder.path() / file);
    EXPECT_THAT(error_of([&] { folder.load(); }),
                ::testing::AllOf(HasSubstr(".xml:"), HasSubstr(", but "), EndsWith("does not exist")))
        << file;
  }
}

TEST(GraspitBody, ReadsCentreMaterialAndGeometry) {
  const GraspitFolder folder;
  const ObjectModel body = load_graspit_body(folder.path() / "iv/link.xml");
  EXPECT_EQ(body.name, "link");
  EXPECT_EQ(body.material, "rubber");
  EXPECT_LT((body.center_of_mass - Vec3(0.001, 0.002, 0.003)).norm(), 1e-15);
  EXPECT_LT((bounding_box(body.mesh).size() - Vec3(0.02, 0.01, 0.01)).norm(), 1e-9);
  const std::string plain =
      "<root><geometryFile>box.iv</geometryFile><geometryScaling>2</geometryScaling>"
      "<geometryOffset><transform><translation>10 0 0</translation></transform></geometryOffset>"
      "</root>";
  const ObjectModel other = load_graspit_body(folder.write("iv/plain.xml", plain));
  EXPECT_EQ(other.material, "wood");
  EXPECT_LT((other.center_of_mass - Vec3(0.01, 0, 0)).norm(), 1e-9);
  EXPECT_LT((bounding_box(other.mesh).size() - Vec3(0.04, 0.02, 0.02)).norm(), 1e-9);
}

TEST(GraspitWorld, ReadsPosesAndFindsFilesFromTheRootFolder) {
  const GraspitFolder folder;
  const std::string world_xml = R"(<world>
  <graspableBody><filename>iv/link.xml</filename>
    <transform><fullTransform>(0 0 0 2)[100 +20 -3]</fullTransform></transform></graspableBody>
  <obstacle><filename>iv/palm.xml</filename></obstacle>
  <robot><filename>robot.xml</filename><dofValues>0.1 +0.2 0 1 0.15 +0 0.01 0</dofValues>
    <transform><fullTransform>(+1 0 0 0)[0 0 50]</fullTransform></transform></robot>
  <camera><position>0 0 0</position></camera>
</world>
)";
  const GraspitWorld world = load_graspit_world(folder.write("worlds/deep/w.xml", world_xml));
  ASSERT_EQ(world.graspable.size(), 1u);
  EXPECT_EQ(world.graspable[0].file, folder.path() / "iv/link.xml");
  EXPECT_LT((world.graspable[0].X_WO.translation() - Vec3(0.1, 0.02, -0.003)).norm(), 1e-15);
  EXPECT_LT((world.graspable[0].X_WO.linear() - Vec3(-1, -1, 1).asDiagonal().toDenseMatrix()).norm(), 1e-15);
  EXPECT_EQ(world.obstacles.size(), 1u);
  ASSERT_EQ(world.robots.size(), 1u);
  const HandModel hand = load_hand(world.robots[0].file);
  // d0; d1 with joints 0 (engaged) and 1 (broke away at 0.15), and d2 with its one joint.
  EXPECT_EQ(graspit_posture(hand, {0.1, 0.2, 0, 1, 0.15, 0.01, 0}), Vec3(0.1, 0.2, 0.01));
  EXPECT_THAT(error_of([&] {
                graspit_posture(hand, {0.1, 0.2});
              }),
              HasSubstr("the 2 dof values of robot end before the flag of chain0_joint1, expected more"));
  EXPECT_THAT(error_of([&] { graspit_posture(hand, world.robots[0].dof_values); }),
              EndsWith("the flag of chain1_joint0 is 0.01, expected 0, or 1 where it broke away"));
  EXPECT_THAT(error_of([&] {
                graspit_posture(hand, {0.1, 0.2, 0, 0, 0.01, 0, 7});
              }),
              EndsWith("7 dof values, expected 6 for robot"));
  folder.write("worlds/bad.xml", with(world_xml, "iv/link.xml", "iv/lnk.xml"));
  EXPECT_THAT(
      error_of([&] { load_graspit_world(folder.path() / "worlds/bad.xml"); }),
      EndsWith(
          "bad.xml:2: <filename> is \"iv/lnk.xml\", but it exists in none of the folders above bad.xml"));
  folder.write("worlds/bad.xml", with(world_xml, "(0 0 0 2)", "(0 0 2)"));
  EXPECT_THAT(
      error_of([&] { load_graspit_world(folder.path() / "worlds/bad.xml"); }),
      EndsWith("bad.xml:3: <fullTransform> is \"(0 0 2)[100 +20 -3]\", expected \"(w x y z)[x y z]\""));
}

}  // namespace
}  // namespace eigengrasp
