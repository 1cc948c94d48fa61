// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Every robot, body and world of GraspIt!'s models is read.
#include <gtest/gtest.h>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "support/graspit_reference.hpp"

namespace eigengrasp {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_under(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ending) files.push_back(entry.path());
  return files;
}

TEST(GraspitFiles, AllRobotsLoad) {
  const auto models = testing::graspit_models();
  EIGENGRASP_REQUIRE_DATA(models);
  int count = 0;
  for (const auto& folder : fs::directory_iterator(models / "robots")) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".xml") continue;
      SCOPED_TRACE(entry.path().string());
      try {
        const HandModel hand = load_hand(entry.path());
        EXPECT_GE(hand.n_dof(), 4);
        EXPECT_GE(hand.collision_pairs.size(), 5u);
        EXPECT_GE(hand.eigengrasps.size(), 2);
        ++count;
      } catch (const Error& e) {
        ADD_FAILURE() << e.what();
      }
    }
  }
  EXPECT_GE(count, 9);
}

TEST(GraspitFiles, AllObjectsLoad) {
  const auto models = testing::graspit_models();
  EIGENGRASP_REQUIRE_DATA(models);
  for (const char* ending : {".xml", ".iv", ".IV", ".wrl"}) {
    for (const fs::path& file : files_under(models / "objects", ending)) {
      if (file.filename() == "default.xml") continue;  // a template without geometry
      SCOPED_TRACE(file.string());
      try {
        EXPECT_FALSE(load_object(file).mesh.empty());
      } catch (const Error& e) {  // soap.xml names a file that GraspIt! does not ship
        EXPECT_EQ(file.filename(), "soap.xml") << e.what();
        EXPECT_TRUE(std::string(e.what()).ends_with("soap.iv does not exist")) << e.what();
      }
    }
  }
}

TEST(GraspitFiles, WorldsLoadWithTheirHandsAndPostures) {
  const auto worlds = testing::test_data("graspit/worlds");
  EIGENGRASP_REQUIRE_DATA(worlds);
  for (const char* name : {"dlr_flask", "plannerMug", "plannerP51", "robonautFlask", "hands"}) {
    SCOPED_TRACE(name);
    const GraspitWorld world = load_graspit_world(worlds / (std::string(name) + ".xml"));
    EXPECT_FALSE(world.robots.empty());
    for (const GraspitWorld::Robot& robot : world.robots) {
      const HandModel hand = load_hand(robot.file, {.load_meshes = false});
      const VecX posture = graspit_posture(hand, robot.dof_values);
      EXPECT_TRUE(((posture - hand.dof_min()).array() > -1e-3).all());
      EXPECT_TRUE(((hand.dof_max() - posture).array() > -1e-3).all());
    }
  }
}

}  // namespace
}  // namespace eigengrasp
