// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/grasp/named_joints.hpp"
#include "eigengrasp/render/picture_grid.hpp"
#include "eigengrasp/render/pictures.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

using testing::ball_grasp;
using testing::ball_scene;
using testing::two_finger_hand;

constexpr Color kWhite{1.0F, 1.0F, 1.0F, 1.0F};

int big_endian(const std::string& bytes, std::size_t at) {
  int value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[i]);
  return value;
}

/// Pixels of the picture that differ from white, inside a rectangle.
int count_marks(const Image& image, int left, int top, int right, int bottom) {
  int marks = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) marks += image.pixel(x, y)[1] < 0.9F ? 1 : 0;
  return marks;
}

PictureOptions small() {
  PictureOptions options;
  options.tile = 80;
  return options;
}

TEST(Png, HasSignatureSizeAndNoAlphaWhereOpaque) {
  const std::string bytes = encode_png(Image(31, 17, kWhite));
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(big_endian(bytes, 16), 31);
  EXPECT_EQ(big_endian(bytes, 20), 17);
  EXPECT_EQ(bytes[24], 8);                                              // bits a component
  EXPECT_EQ(bytes[25], 2);                                              // RGB
  EXPECT_EQ(encode_png(Image(3, 3, {1.0F, 0.0F, 0.0F, 0.5F}))[25], 6);  // RGBA
}

TEST(Png, SrgbAndLinearAreInverse) {
  for (int i = 0; i <= 255; ++i) {
    const float c = static_cast<float>(i) / 255.0F;
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(c)), c, 1e-5F);
  }
}

TEST(Png, RefusesAnEmptyImageAndWritesNothing) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "eigengrasp_empty.png";
  std::filesystem::remove(file);
  EXPECT_THROW(save_png(Image(), file), Error);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(PictureGrid, PlacesTilesRowByRow) {
  PictureGrid grid;
  grid.columns = 2;
  grid.tiles = {Image(40, 40, {1, 0, 0, 1}), Image(40, 40, {0, 1, 0, 1}), Image(40, 40, {0, 0, 1, 1})};
  const Image sheet = draw_grid(grid);
  const int right = 3 * sheet.width / 4;
  const int bottom = 3 * sheet.height / 4;
  EXPECT_NEAR(sheet.color(sheet.width / 4, sheet.height / 4).r, 1.0F, 0.01F);
  EXPECT_NEAR(sheet.color(sheet.width / 4, sheet.height / 4).g, 0.0F, 0.01F);
  EXPECT_NEAR(sheet.color(right, sheet.height / 4).g, 1.0F, 0.01F);
  EXPECT_NEAR(sheet.color(sheet.width / 4, bottom).b, 1.0F, 0.01F);
  EXPECT_NEAR(sheet.color(right, bottom).r, 1.0F, 0.01F);  // the free place
}

TEST(PictureGrid, WritesTitlesCaptionsAndHeadingInTheirPlaces) {
  PictureGrid grid;
  grid.tiles = {Image(100, 100, kWhite)};
  const int plain = draw_grid(grid).height;
  EXPECT_EQ(count_marks(draw_grid(grid), 0, 0, 100, 100), 0);
  grid.heading = "Heading";
  const Image headed = draw_grid(grid);
  EXPECT_GT(headed.height, plain);
  EXPECT_GT(count_marks(headed, 0, 0, headed.width, headed.height - plain + 14), 20);
  grid.titles = {"title"};
  grid.captions = {"caption"};
  const Image full = draw_grid(grid);
  EXPECT_GT(full.height, headed.height);
  EXPECT_GT(count_marks(full, 0, full.height - 40, full.width, full.height), 20);
}

TEST(PictureGrid, LongTextStaysOnTheSheet) {
  PictureGrid grid;
  grid.tiles = {Image(120, 50, kWhite)};
  grid.captions = {std::string(300, 'W')};
  const Image sheet = draw_grid(grid);
  EXPECT_EQ(count_marks(sheet, 0, 0, 8, sheet.height), 0);
  EXPECT_EQ(count_marks(sheet, sheet.width - 8, 0, sheet.width, sheet.height), 0);
  EXPECT_GT(count_marks(sheet, 8, 0, sheet.width - 8, sheet.height), 50);
}

TEST(PictureGrid, MendsTextThatIsNotUtf8) {
  PictureGrid grid;
  grid.tiles = {Image(120, 50, kWhite), Image(120, 50, kWhite)};
  grid.columns = 2;
  grid.captions = {"caf\xe9 \xff\xc3(\n", "plain"};
  const Image sheet = draw_grid(grid);
  EXPECT_GT(count_marks(sheet, 0, 50, sheet.width / 2, sheet.height), 10);
  EXPECT_GT(count_marks(sheet, sheet.width / 2, 50, sheet.width, sheet.height), 10);
}

TEST(PictureGrid, RefusesCountsThatDoNotMatch) {
  PictureGrid grid;
  grid.tiles = {Image(10, 10, kWhite)};
  grid.titles = {"a", "b"};
  EXPECT_THROW(draw_grid(grid), Error);
  grid.titles.clear();
  grid.columns = 0;
  EXPECT_THROW(draw_grid(grid), Error);
}

TEST(HandPictures, FingersPointAwayFromThePalm) {
  EXPECT_NEAR((finger_direction(*two_finger_hand()) - Vec3::UnitZ()).norm(), 0.0, 1e-9);
}

TEST(HandPictures, JointsByNameFillInTheRestPosture) {
  const auto hand = two_finger_hand();
  const VecX joints = joints_by_name(*hand, {{"right_distal", 0.7}});
  EXPECT_EQ(joints.size(), 4);
  EXPECT_EQ(joints[3], 0.7);
  EXPECT_EQ(joints[0], 0.0);
  EXPECT_THROW(joints_by_name(*hand, {{"thumb", 0.7}}), Error);
}

TEST(HandPictures, HaveTheirTiles) {
  const auto hand = two_finger_hand();
  const Image one = hand_picture(hand, VecX::Zero(4), small());
  const Image table = eigengrasp_picture(hand, 2, small());
  const Image contacts = hand_contacts_picture(hand, small());
  EXPECT_GT(table.width, 3 * 80);
  EXPECT_GT(table.height, 2 * 80);
  EXPECT_GT(contacts.width, 2 * 80);
  EXPECT_GT(count_marks(one, 0, 40, one.width, one.height), 300);
  EXPECT_GT(hands_side_by_side(std::vector<std::shared_ptr<const HandModel>>{hand, hand}, {}, small()).width,
            2 * 80);
}

TEST(HandPictures, SayWhatIsMissing) {
  auto bare = std::make_shared<HandModel>(*two_finger_hand());
  bare->eigengrasps = EigengraspSpace();
  EXPECT_THROW(eigengrasp_picture(bare, 2, small()), Error);
  for (HandLink& link : bare->links) link.mesh = {};
  EXPECT_THROW(hand_picture(bare, VecX::Zero(4), small()), Error);
}

TEST(GraspPictures, ShowContactsInTheirColour) {
  const Scene scene = ball_scene();
  Grasp grasp = ball_grasp();
  const auto count_red = [](const Image& image) {
    int red = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Color c = image.color(x, y);
        red += c.r > 1.5F * c.g && c.r > 1.5F * c.b ? 1 : 0;
      }
    return red;
  };
  PictureOptions options = small();
  options.tile = 200;
  options.view = Vec3(0.0, 1.0, -0.2);
  const Image with = grasps_picture(scene, std::vector<Grasp>{grasp}, options);
  EXPECT_GT(count_red(with), 4);
  grasp.contacts.clear();
  EXPECT_EQ(count_red(grasps_picture(scene, std::vector<Grasp>{grasp}, options)), 0);
}

TEST(GraspPictures, AreTheSameWithAnyNumberOfThreads) {
  Scene scene = ball_scene();
  scene.obstacles.push_back({std::make_shared<const ObjectModel>(
                                 make_object("table", testing::box_mesh({2.0, 2.0, 0.05}, {0.0, 0.0, -0.2}))),
                             Pose::Identity()});
  const std::vector<Grasp> grasps(5, ball_grasp());
  PictureOptions options = small();
  options.friction_cones = true;
  options.threads = 1;
  const Image one = grasps_picture(scene, grasps, options);
  options.threads = 2;
  EXPECT_EQ(one.rgba, grasps_picture(scene, grasps, options).rgba);
}

TEST(GraspPictures, PairHasTwoTilesAndNoGraspIsAnError) {
  const Image pair = grasp_pair_picture(ball_scene(), ball_grasp(), small());
  EXPECT_GT(pair.width, 2 * 80);
  EXPECT_THROW(grasps_picture(ball_scene(), {}, small()), Error);
}

}  // namespace
}  // namespace eigengrasp
