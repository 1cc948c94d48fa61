// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/model_io/hand_io.hpp"
#include "unit/model_io_fixture.hpp"

namespace eigengrasp {
namespace {

using testing::cube_obj;
using ::testing::EndsWith;
using testing::error_of;
using ::testing::HasSubstr;
using testing::small_urdf;
using testing::small_yaml;
using testing::TempFolder;
using testing::with;

HandModel load_text(const std::string& yaml, HandReadOptions options = {}) {
  const TempFolder folder;
  folder.write("cube.obj", cube_obj(0.06));
  folder.write("gripper.urdf", small_urdf);
  folder.write("hand.yaml", yaml);
  return load_hand(folder.path(), options);
}

TEST(HandYaml, ReadsAllOfIt) {
  const HandModel hand = load_text(small_yaml);
  EXPECT_EQ(hand.name, "gripper");
  EXPECT_EQ(hand.title, "A gripper for tests");
  EXPECT_EQ(hand.source.filename(), "hand.yaml");
  EXPECT_EQ(hand.approach_point_H, Vec3(0, 0, 0.03));
  EXPECT_EQ(hand.approach_direction_H, Vec3::UnitZ());
  EXPECT_EQ(hand.dof_names(), (std::vector<std::string>{"slide", "mcp"}));  // the order of the yaml file
  EXPECT_EQ(hand.joints[0].dof, 1);
  EXPECT_EQ(hand.joints[2].dof, 0);
  EXPECT_EQ(hand.dofs[0].rest, 0.01);
  EXPECT_EQ(hand.dofs[0].closing_speed, -0.1);
  EXPECT_EQ(hand.dofs[0].type, DofType::rigid);
  EXPECT_EQ(hand.dofs[1].type, DofType::breakaway);
  EXPECT_EQ(hand.links[0].material.friction, 0.8);
  EXPECT_EQ(hand.links[2].material.name, "pad");
  EXPECT_EQ(hand.links[2].material.youngs_modulus, 1.5e6);
  EXPECT_EQ(hand.links[3].material.name, "rubber");
  EXPECT_FALSE(hand.links[3].material.friction.has_value());
  ASSERT_EQ(hand.eigengrasps.size(), 1);
  EXPECT_EQ(hand.eigengrasps.origin(), Eigen::Vector2d(0, 0.4));
  EXPECT_LT((hand.eigengrasps[0].direction - Eigen::Vector2d(0.8, 0.6)).norm(), 1e-15);
  EXPECT_EQ(hand.eigengrasps[0].min, -2);
  EXPECT_EQ(hand.eigengrasps[0].name, "close");
  ASSERT_EQ(hand.virtual_contacts.size(), 2u);
  EXPECT_EQ(hand.virtual_contacts[0].n_LC, -Vec3::UnitZ());
  EXPECT_EQ(hand.virtual_contacts[1].link, 2);  // given in a frame of the link
  EXPECT_EQ(hand.virtual_contacts[1].p_LC, Vec3(0.035, 0, 0));
  EXPECT_EQ(hand.collision_pairs, (std::vector<std::array<int, 2>>{{1, 3}, {2, 3}}));
}

TEST(HandYaml, TakesOtherKeysFromTheHandItIsBasedOn) {
  const TempFolder folder;
  folder.write("base/cube.obj", cube_obj(0.06));
  folder.write("base/gripper.urdf", small_urdf);
  folder.write("base/hand.yaml", small_yaml);
  folder.write("slippery/hand.yaml", R"(format: eigengrasp-hand
version: 1
based_on: ../base
name: slippery
materials:
  skin: {friction: 0.1}
  pad: {friction: 0.2}
)");
  const HandModel hand = load_hand(folder.path() / "slippery");
  EXPECT_EQ(hand.name, "slippery");
  EXPECT_EQ(hand.title, "A gripper for tests");
  EXPECT_EQ(hand.links[0].material.friction, 0.1);
  EXPECT_EQ(hand.links[2].material.friction, 0.2);
  EXPECT_EQ(hand.n_dof(), 2);
  EXPECT_FALSE(hand.links[0].mesh.empty());  // the mesh is found from the base's folder
}

TEST(HandYaml, RefusesCyclesOfBasedOn) {
  const TempFolder folder;
  folder.write("a/hand.yaml", "format: eigengrasp-hand\nversion: 1\nbased_on: ../b\n");
  folder.write("b/hand.yaml", "format: eigengrasp-hand\nversion: 1\nbased_on: ../a/hand.yaml\n");
  EXPECT_THAT(
      error_of([&] { load_hand(folder.path() / "a"); }),
      EndsWith("b/hand.yaml:3: based_on is \"../a/hand.yaml\", which is based on this file itself, expected "
               "another hand"));
}

TEST(HandYaml, KeepsToAFolderWhereItIsToldTo) {
  const TempFolder folder;
  folder.write("cube.obj", cube_obj(0.06));
  folder.write("gripper.urdf", small_urdf);
  folder.write("in/cube.obj", cube_obj(0.06));
  folder.write("in/gripper.urdf", small_urdf);
  folder.write("in/hand.yaml", small_yaml);
  const HandReadOptions bounds{.only_within = folder.path() / "in"};
  EXPECT_EQ(load_hand(folder.path() / "in", bounds).name, "gripper");
  const auto refusal_of = [&] { return error_of([&] { load_hand(folder.path() / "in", bounds); }); };

  folder.write("in/hand.yaml", with(small_yaml, "urdf: gripper.urdf", "urdf: ../gripper.urdf"));
  EXPECT_THAT(refusal_of(), HasSubstr("urdf is \"../gripper.urdf\", which lies outside"));
  folder.write("in/hand.yaml", with(small_yaml, "urdf: gripper.urdf", "urdf: /etc/passwd"));
  EXPECT_THAT(refusal_of(), HasSubstr("urdf is \"/etc/passwd\", which lies outside"));
  folder.write("in/hand.yaml", "format: eigengrasp-hand\nversion: 1\nbased_on: ..\n");
  EXPECT_THAT(refusal_of(), HasSubstr("based_on is \"..\", which lies outside"));

  folder.write("in/hand.yaml", small_yaml);
  folder.write("in/gripper.urdf", with(small_urdf, "cube.obj", "../cube.obj"));
  EXPECT_THAT(refusal_of(), HasSubstr("filename is \"../cube.obj\", which lies outside"));
  folder.write("in/gripper.urdf", with(small_urdf, "cube.obj", "file:///etc/passwd"));
  EXPECT_THAT(refusal_of(), HasSubstr("filename is \"file:///etc/passwd\", which lies outside"));
  const std::string package = "package://" + folder.path().filename().string() + "/cube.obj";
  folder.write("in/gripper.urdf", with(small_urdf, "cube.obj", package));
  EXPECT_THAT(refusal_of(), HasSubstr("is in no package"));
  EXPECT_EQ(load_hand(folder.path() / "in").name, "gripper");  // without bounds it is found
}

TEST(HandYaml, SaysWhatItAssumes) {
  const auto short_yaml = small_yaml.substr(0, small_yaml.find("eigengrasps:"));
  const auto text = with(short_yaml, "approach:\n  point: [0, 0, 0.03]\n  direction: [0, 0, 2]\n", "");
  std::string heard;
  const HandModel hand = load_text(text, {.log = [&](const std::string& s) { heard += s + "\n"; }});
  EXPECT_THAT(heard, HasSubstr("has no approach; the hand comes along the base's z axis"));
  EXPECT_THAT(heard, HasSubstr("has no eigengrasps; every degree of freedom is a direction"));
  EXPECT_EQ(hand.eigengrasps.size(), 2);
  EXPECT_EQ(hand.eigengrasps.origin()[0], 0.01);  // about the rest posture
}

struct BadYaml {
  std::string from, to, expected;
};

TEST(HandYaml, EveryErrorNamesFileLineValueAndExpectation) {
  const std::vector<BadYaml> cases = {
      {"format: eigengrasp-hand", "format: hand", ":1: format is \"hand\", expected eigengrasp-hand"},
      {"format: eigengrasp-hand\n", "", ":1: the file has no key \"format\", expected one"},
      {"version: 1", "version: 2", ":2: version is \"2\", expected 1, the only one that this program reads"},
      {"title:", "titel:",
       "title, based_on, urdf, approach, materials, link_materials, dofs, eigengrasps, "
       "virtual_contacts, ignore_collisions (did you mean \"title\"?)"},
      {"title: A gripper for tests", "name: twice", ":4: name comes twice, expected it once"},
      {"name: gripper\n", "", "hand.yaml: has no key \"name\", expected one"},
      {"  point: [0, 0, 0.03]", "  point: [0, 0",
       ":8: is not well-formed YAML (end of sequence flow not found)"},
      {"urdf: gripper.urdf", "urdf: [1]", ":5: urdf is \"[1]\", expected text"},
      {"point: [0, 0, 0.03]", "point: [0, 0]", ":7: point is \"[0, 0]\", expected a list of 3 numbers"},
      {"point: [0, 0, 0.03]", "point: [0, 0, .inf]",
       ":7: point is \"[0, 0, .inf]\", expected a list of 3 numbers"},
      {"point: [0, 0, 0.03]", "point: 5", ":7: point is \"5\", expected a list of 3 numbers"},
      {"direction: [0, 0, 2]", "direction: [0, 0, 0]",
       ":8: direction is \"[0, 0, 0]\", expected a direction that is not zero"},
      {"  direction: [0, 0, 2]\n", "", ":7: approach has no key \"direction\", expected one"},
      {"skin: {friction: 0.8}", "skin: {friction: -1}",
       ":10: friction is \"-1\", expected a number that is not negative"},
      {"skin: {friction: 0.8}", "skin: {youngs_modulus: 1e6}",
       ":10: material skin has no friction, expected one (or one of the names that bring theirs: glass, "
       "metal, wood, "
       "plastic, rubber, stone, frictionless)"},
      {"skin: {friction: 0.8}", "skin: {frction: 1}",
       ":10: unknown key \"frction\" in skin, expected one of friction, youngs_modulus (did you mean "
       "\"friction\"?)"},
      {"youngs_modulus: 1.5e6", "youngs_modulus: soft", ":11: youngs_modulus is \"soft\", expected a number"},
      {"default: skin", "default: skn",
       ":13: the material of default is \"skn\", expected one of glass, metal, wood, plastic, rubber, stone, "
       "frictionless, pad, skin (did you mean \"skin\"?)"},
      {"  distal: pad", "  distl: pad",
       ":14: link_materials names \"distl\", expected a link of the URDF with a surface (did you mean "
       "\"distal\"?)"},
      {"joint: slide", "joint: slid",
       ":17: joint is \"slid\", expected a joint of gripper.urdf that moves on its own (did you mean "
       "\"slide\"?)"},
      {"joint: slide", "joint: pip",
       ":17: joint is \"pip\", which is fixed or mimics another, expected a joint of gripper.urdf that moves "
       "on its "
       "own (did you mean \"mcp\"?)"},
      {"joint: slide", "joint: mcp", ":18: item 2 of dofs names mcp again, expected every joint once"},
      {"  - {joint: slide, closing_speed: -0.1, rest: 0.01}\n", "",
       ":17: dofs lists 1 of the 2 joints that move on their own, expected all: slide missing"},
      {"closing_speed: -0.1", "clsing_speed: -0.1",
       ":17: unknown key \"clsing_speed\" in item 1 of dofs, expected one of joint, closing_speed, type, "
       "rest (did you "
       "mean \"closing_speed\"?)"},
      {"closing_speed: -0.1", "closing_speed: fast", ":17: closing_speed is \"fast\", expected a number"},
      {"rest: 0.01", "rest: 0.5",
       ":17: rest of slide is \"0.5\", expected a value within its limits, 0 to 0.03"},
      {"type: breakaway", "type: brakeaway",
       ":18: type is \"brakeaway\", expected rigid or breakaway (did you mean \"breakaway\"?)"},
      {"origin: {mcp: 0.4}", "origin: {mcpp: 0.4}",
       ":20: origin names \"mcpp\", expected a degree of freedom (did you mean \"mcp\"?)"},
      {"range: [-2, 3]", "range: [3, -2]", ":23: range is \"[3, -2]\", expected the smaller number first"},
      {"vector: {mcp: 3.0, slide: 4.0}", "vector: {mcp: 0}",
       ":22: eigengrasp 1 (\"close\"): the direction is zero, expected a direction with a length"},
      {"vector: {mcp: 3.0, slide: 4.0}", "vector: [3, 4]",
       ":24: vector is \"[3, 4]\", expected a map of keys and values"},
      {"{link: distal,", "{link: distl,",
       ":26: link is \"distl\", expected a link of the URDF (did you mean \"distal\"?)"},
      {"normal: [0, 0, -2]", "normal: [0, 0, 0]",
       ":26: normal is \"[0, 0, 0]\", expected a direction that is not zero"},
      {"- [palm, distal]", "- [palm]", ":29: item 1 of ignore_collisions is \"[palm]\", expected two links"},
      {"- [palm, distal]", "- [palm, 7]",
       ":29: item 2 of item 1 of ignore_collisions is \"7\", expected a link of the URDF"},
  };
  for (const BadYaml& bad : cases) {
    SCOPED_TRACE(bad.to);
    const std::string sentence = error_of([&] { load_text(with(small_yaml, bad.from, bad.to)); });
    EXPECT_THAT(sentence, HasSubstr("hand.yaml:"));
    EXPECT_THAT(sentence, EndsWith(bad.expected));
  }
}

TEST(HandYaml, RefusesMissingFiles) {
  EXPECT_THAT(error_of([] { load_text(with(small_yaml, "urdf: gripper.urdf", "urdf: griper.urdf")); }),
              ::testing::AllOf(HasSubstr("hand.yaml:5: urdf is \"griper.urdf\", but "),
                               EndsWith("griper.urdf does not exist")));
  EXPECT_THAT(error_of([] { load_text(with(small_yaml, "title:", "based_on: ../nobody\ntitle:")); }),
              ::testing::AllOf(HasSubstr("hand.yaml:4: based_on is \"../nobody\", but "),
                               EndsWith("does not exist")));
  EXPECT_THAT(error_of([] { load_text("just text"); }),
              EndsWith("hand.yaml:1: the file is \"just text\", expected a map of keys and values"));
}

}  // namespace
}  // namespace eigengrasp
