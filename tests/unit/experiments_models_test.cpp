// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Where the models of the experiments come from, and the figures ours are compared with.
#include <gtest/gtest.h>

#include <fstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/experiments/paper_scenes.hpp"
#include "eigengrasp/experiments/reference_figures.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "support/test_data.hpp"

namespace eigengrasp {
namespace {

namespace fs = std::filesystem;

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(PaperScenes, NamesAreReadAsTheyAreWritten) {
  for (const PaperHand hand : kPaperHands) EXPECT_EQ(parse_paper_hand(name_of(hand)), hand);
  for (const PaperObject object : kPaperObjects) EXPECT_EQ(parse_paper_object(name_of(object)), object);
  const std::string sentence = error_of([] { parse_paper_hand("shadow"); });
  EXPECT_NE(sentence.find("'shadow'"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("barrett, dlr, robonaut, human"), std::string::npos) << sentence;
}

TEST(PaperScenes, FoldersWithoutModelsAreRefusedByName) {
  const fs::path folder = fs::path(::testing::TempDir()) / "eigengrasp-no-models";
  fs::remove_all(folder);
  EXPECT_NE(error_of([&] { find_graspit_models(folder); }).find("is no folder"), std::string::npos);
  fs::create_directories(folder / "models" / "robots" / "Barrett");
  std::ofstream(folder / "models" / "robots" / "Barrett" / "Barrett.xml") << "<robot/>";
  const std::string sentence = error_of([&] { find_graspit_models(folder); });
  EXPECT_NE(sentence.find("holds no robots/DLR/DLR.xml"), std::string::npos) << sentence;
  fs::remove_all(folder);
}

TEST(PaperScenes, ShippedHandsAndObjectsLoad) {
  const PaperScenes models({}, {PaperHand::barrett, PaperHand::human}, {PaperObject::glass});
  const Scene own = models.scene(PaperHand::barrett, PaperObject::glass, FrictionCase::materials);
  EXPECT_EQ(own.hand->name, "barrett-metal");
  EXPECT_EQ(own.object->name, "glass");
  EXPECT_EQ(contact_friction(own.hand->links[0].material, own.object_material), 0.4);
  const Scene one = models.scene(PaperHand::human, PaperObject::glass, FrictionCase::one);
  for (const HandLink& link : one.hand->links)
    EXPECT_EQ(contact_friction(link.material, one.object_material), 1.0) << link.name;
}

// Counts of virtual contacts and degrees of freedom: as the test data's description gives them.
TEST(PaperScenes, GraspitModelsHaveTheirContacts) {
  const fs::path folder = testing::test_data("graspit/models");
  EIGENGRASP_REQUIRE_DATA(folder);
  const ModelSource source = find_graspit_models(folder);
  EXPECT_EQ(find_graspit_models(folder.parent_path()).graspit, source.graspit);
  const std::array<std::size_t, 4> contacts{19, 13, 15, 18};
  const std::array dofs{4, 12, 13, 20};
  for (std::size_t i = 0; i < kPaperHands.size(); ++i) {
    const HandModel hand = load_paper_hand(source, kPaperHands[i], {.load_meshes = false});
    EXPECT_EQ(hand.virtual_contacts.size(), contacts[i]) << hand.name;
    EXPECT_EQ(hand.n_dof(), dofs[i]) << hand.name;
    EXPECT_GE(hand.eigengrasps.size(), 2) << hand.name;
  }
  for (const PaperObject object : kPaperObjects)
    EXPECT_GT(load_paper_object(source, object).max_radius, 0.03) << name_of(object);
}

// Means that the paper and the measurement's notes give for the whole tables.
TEST(ReferenceFigures, HaveTheirKnownMeans) {
  std::vector<double> paper, graspit;
  for (const PaperHand hand : kPaperHands)
    for (const PaperObject object : kPaperObjects) {
      paper.push_back(paper_form_closed(hand, object));
      graspit.push_back(graspit_form_closed(hand, object));
    }
  EXPECT_NEAR(mean(paper), 6.8, 0.05);
  EXPECT_NEAR(mean(graspit), 5.7, 0.05);
}

// Closed forms.
TEST(Statistics, AreThoseOfASample) {
  EXPECT_EQ(mean({}), 0.0);
  EXPECT_EQ(standard_deviation({3.0}), 0.0);
  EXPECT_EQ(median({}), 0.0);
  EXPECT_DOUBLE_EQ(mean({1.0, 2.0, 6.0}), 3.0);
  EXPECT_DOUBLE_EQ(standard_deviation({2.0, 4.0}), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(standard_deviation({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}), std::sqrt(32.0 / 7.0));
  EXPECT_DOUBLE_EQ(median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_DOUBLE_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
}

}  // namespace
}  // namespace eigengrasp
