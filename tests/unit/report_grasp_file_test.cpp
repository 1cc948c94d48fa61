// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/report/grasp_file.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

using testing::ball_grasp;
using testing::ball_scene;
using Json = nlohmann::ordered_json;

Pose random_pose(RandomStream& random) {
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  return make_pose(q, Vec3(random.normal(), random.normal(), random.normal()));
}

GraspFile example() {
  Scene scene = ball_scene();
  scene.object_material.name = "wood";
  scene.object_material.friction = 0.35;
  scene.obstacles.push_back(
      {std::make_shared<const ObjectModel>(make_object("table", testing::box_mesh({2.0, 2.0, 0.05}))),
       make_pose(Eigen::Quaterniond::Identity(), {0.0, 0.0, -0.1})});
  PlanResult result;
  result.status = PlanStatus::found;
  result.explanation = "2 of 20 grasps are form-closed";
  result.grasps = {ball_grasp(), ball_grasp()};
  result.grasps[1].form_closure = false;
  result.grasps[1].epsilon = 0.0;
  result.states = {70000, 60000, 5000, 4000, 1000};
  result.candidates = {20, 2, 12, 5, 1};
  result.timings = {0.1, 0.25, 1.0 / 3.0, 0.7};
  result.milestones = {{17, 3.5, make_pose({1, 2, 3, 4}, {0, 0, 1}), VecX::Constant(2, 0.5)}};
  PlanOptions options;
  options.seed = 12345678901234567890ULL;
  options.energy = EnergyKind::wrench;
  options.norm = WrenchNorm::linf;
  options.cone = ConeModel::exact;
  options.threads = 2;
  return make_grasp_file(scene, {"mm", 1.5}, options, std::move(result));
}

/// The error of reading the example after a change.
std::string error_after(const std::function<void(Json&)>& change) {
  Json json = Json::parse(grasps_json(example()));
  change(json);
  try {
    parse_grasps(json.dump(), "some/grasps.json");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(GraspFile, ReadsWhatItWroteExactly) {
  const GraspFile file = example();
  const GraspFile again = parse_grasps(grasps_json(file), "text");
  EXPECT_EQ(again.hand.joints, file.hand.joints);
  EXPECT_EQ(again.hand.dofs, file.hand.dofs);
  EXPECT_EQ(again.object.units, "mm");
  EXPECT_EQ(again.object.scale, 1.5);
  EXPECT_EQ(again.object.material.friction, 0.35);
  EXPECT_EQ(again.object.center_of_mass, file.object.center_of_mass);
  EXPECT_EQ(again.obstacles.at(0).name, "table");
  EXPECT_EQ(again.options.seed, 12345678901234567890ULL);
  EXPECT_EQ(again.options.energy, EnergyKind::wrench);
  EXPECT_EQ(again.options.norm, WrenchNorm::linf);
  EXPECT_EQ(again.options.cone, ConeModel::exact);
  EXPECT_EQ(again.result.states.hit_itself, 4000);
  EXPECT_EQ(again.result.candidates.penetrating, 1);
  EXPECT_EQ(again.result.timings.close, 1.0 / 3.0);
  EXPECT_EQ(again.result.milestones.at(0).iteration, 17);
  ASSERT_EQ(again.result.grasps.size(), 2U);
  const Grasp& a = file.result.grasps[0];
  const Grasp& b = again.result.grasps[0];
  EXPECT_EQ(b.hand, "gripper");
  EXPECT_EQ(b.object, "ball");
  EXPECT_EQ(b.pregrasp_joints, a.pregrasp_joints);
  EXPECT_EQ(b.grasp_joints, a.grasp_joints);
  EXPECT_EQ(b.grasp_dofs, a.grasp_dofs);
  EXPECT_EQ(b.amplitudes, a.amplitudes);
  EXPECT_EQ(b.energy, a.energy);
  EXPECT_EQ(b.epsilon, a.epsilon);
  EXPECT_EQ(b.volume, a.volume);
  EXPECT_EQ(b.max_penetration, a.max_penetration);
  EXPECT_EQ(b.provenance.seed, a.provenance.seed);
  EXPECT_EQ(b.contacts.at(1).link, "right_distal");
  EXPECT_EQ(b.contacts.at(1).point.p_OC, a.contacts[1].point.p_OC);
  EXPECT_EQ(b.X_OH_pregrasp.translation(), a.X_OH_pregrasp.translation());
  EXPECT_NEAR((b.X_OH_pregrasp.linear() - a.X_OH_pregrasp.linear()).norm(), 0.0, 1e-14);
  EXPECT_EQ(parse_grasps(grasps_json(file), "text").result.explanation, file.result.explanation);
}

TEST(GraspFile, WrittenAgainItIsTheSameText) {
  RandomStream random{7};
  for (int i = 0; i < 300; ++i) {
    GraspFile file = example();
    for (Grasp& grasp : file.result.grasps) {
      grasp.X_OH = random_pose(random);
      grasp.X_OH_pregrasp = random_pose(random);
      grasp.energy = random.normal() * 1e-5;
    }
    const std::string text = grasps_json(file);
    ASSERT_TRUE(grasps_json(parse_grasps(text, "text")) == text) << "round " << i;
  }
}

TEST(GraspFile, WithoutTheRunTwoRunsAreEqualByteByByte) {
  GraspFile slow = example();
  slow.result.timings = {9.0, 8.0, 7.0, 24.0};
  slow.options.threads = 1;
  EXPECT_NE(grasps_json(example()), grasps_json(slow));
  EXPECT_TRUE(grasps_json(example(), RunPart::without) == grasps_json(slow, RunPart::without));
  EXPECT_EQ(parse_grasps(grasps_json(slow, RunPart::without), "text").result.timings.total, 0.0);
}

TEST(GraspFile, SaysItsFormatUnitsAndFrames) {
  const Json json = Json::parse(grasps_json(example()));
  EXPECT_EQ(json["format"], "eigengrasp-grasps");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["conventions"]["orientation"], "unit quaternion [w, x, y, z]");
  const auto& grasp = json["grasps"][0];
  EXPECT_EQ(grasp["rank"], 1);
  EXPECT_EQ(grasp["grasp"]["hand_pose"]["orientation"][0], 1.0);
  EXPECT_EQ(grasp["grasp"]["joints"]["left_distal"], 1.0 / 3.0);
  EXPECT_EQ(json["run"]["threads"], 2);
  EXPECT_EQ((--json.end()).key(), "run");
}

TEST(GraspFile, NamesPathValueAndExpectation) {
  EXPECT_EQ(error_after([](Json& j) { j["grasps"][1]["contacts"][0]["mu"] = -0.5; }),
            "some/grasps.json: grasps[1].contacts[0].mu: found -0.5, expected a number of at least 0");
  EXPECT_EQ(
      error_after([](Json& j) {
        j["grasps"][0]["grasp"]["hand_pose"]["orientation"] = {1, 1, 0, 0};
      }),
      "some/grasps.json: grasps[0].grasp.hand_pose.orientation: found an array of 4, expected a quaternion "
      "[w, x, y, z] of length 1");
  EXPECT_EQ(error_after([](Json& j) { j["grasps"][0].erase("epsilon"); }),
            "some/grasps.json: grasps[0].epsilon: is missing");
  EXPECT_EQ(
      error_after([](Json& j) { j["grasps"][0]["grasp"]["joints"]["thumb"] = 1.0; }),
      "some/grasps.json: grasps[0].grasp.joints.thumb: found 1.0, expected the name of one of hand.joints");
  EXPECT_EQ(
      error_after([](Json& j) { j["grasps"][0]["grasp"]["joints"].erase("left_distal"); }),
      "some/grasps.json: grasps[0].grasp.joints: found an object, expected an object with the 4 joints of "
      "hand.joints");
  EXPECT_EQ(error_after([](Json& j) {
              j["grasps"][0]["grasp"]["dofs"] = {1, 2, 3};
            }),
            "some/grasps.json: grasps[0].grasp.dofs: found an array of 3, expected an array of 2 numbers");
  EXPECT_EQ(error_after([](Json& j) { j["options"]["energy"] = "potential"; }),
            "some/grasps.json: options.energy: found \"potential\", expected one of contact, wrench");
  EXPECT_EQ(error_after([](Json& j) { j["object"]["scale"] = 0; }),
            "some/grasps.json: object.scale: found 0, expected a number above 0");
  EXPECT_EQ(error_after([](Json& j) { j["grasps"] = 5; }),
            "some/grasps.json: grasps: found 5, expected an array");
  EXPECT_EQ(error_after([](Json& j) { j["statistics"]["states"]["legal"] = -1; }).substr(0, 60),
            "some/grasps.json: statistics.states.legal: found -1, expecte");
}

TEST(GraspFile, RefusesWhatIsNewerOrSomethingElse) {
  EXPECT_EQ(
      error_after([](Json& j) { j["version"] = 2; }),
      "some/grasps.json: version: found 2, expected at most 1: the file was written by a newer eigengrasp, "
      "update this program to read it");
  EXPECT_EQ(error_after([](Json& j) { j["format"] = "recipes"; }),
            "some/grasps.json: format: found \"recipes\", expected \"eigengrasp-grasps\"");
  EXPECT_THROW(parse_grasps("[]", "x"), Error);
  EXPECT_THROW(parse_grasps("", "x"), Error);
  try {
    parse_grasps("{\n\"format\": \"eigengrasp-grasps\",\n oops", "x.json");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).substr(0, 22), "x.json:3: is not JSON ");
  }
}

TEST(GraspFile, IgnoresMembersThatItDoesNotKnow) {
  EXPECT_EQ(error_after([](Json& j) { j["grasps"][0]["comment"] = "mine"; }), "");
}

TEST(GraspFile, WritesNoNumberThatIsNotFinite) {
  GraspFile file = example();
  file.result.grasps[0].energy = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(grasps_json(file), std::logic_error);
}

TEST(GraspFile, SavesAndLoadsWholeFiles) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "eigengrasp_report" / "grasps.json";
  save_grasps(example(), path);
  EXPECT_TRUE(grasps_json(load_grasps(path)) == grasps_json(example()));
  EXPECT_EQ(file_digest(path), bytes_digest(read_text_file(path)));
  std::filesystem::remove_all(path.parent_path());
  EXPECT_THROW(load_grasps(path), Error);
}

TEST(Digest, IsThePublishedFnv1a) {
  // Test vectors of Fowler, Noll and Vo.
  EXPECT_EQ(bytes_digest(""), "fnv1a64:cbf29ce484222325");
  EXPECT_EQ(bytes_digest("a"), "fnv1a64:af63dc4c8601ec8c");
  EXPECT_EQ(bytes_digest("foobar"), "fnv1a64:85944171f73967e8");
}

}  // namespace
}  // namespace eigengrasp
