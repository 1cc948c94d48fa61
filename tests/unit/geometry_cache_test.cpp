// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Fields of rescaled objects against fields made anew and exact distances; what the cache returns against
// what is made anew, over damaged files, several writers and folders that cannot be written to.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/geometry/ball_cover.hpp"
#include "eigengrasp/geometry/preparation_cache.hpp"
#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

namespace fs = std::filesystem;

DistanceFieldOptions small_options() {
  DistanceFieldOptions options;
  options.cell = 0.004;
  options.far_margin = 0.04;
  return options;
}

ObjectModel torus() {
  return make_object("torus", testing::torus_mesh(0.04, 0.012, 16));
}

void expect_same(const DistanceField& a, const DistanceField& b) {
  for (const auto& [x, y] : {std::pair{&a.fine(), &b.fine()}, std::pair{&a.coarse(), &b.coarse()}}) {
    EXPECT_EQ(x->values, y->values);
    EXPECT_EQ(x->nodes, y->nodes);
    EXPECT_EQ(x->origin, y->origin);
    EXPECT_EQ(x->cell, y->cell);
  }
  EXPECT_EQ(a.scale(), b.scale());
}

class PreparationCacheTest : public ::testing::Test {
 protected:
  PreparationCacheTest() {
    static int count = 0;
    folder_ = fs::temp_directory_path() / fmt::format("eigengrasp_cache_{}_{}", ::getpid(), count++);
  }
  ~PreparationCacheTest() override {
    std::error_code ec;
    fs::permissions(folder_, fs::perms::owner_all, ec);
    fs::remove_all(folder_, ec);
  }
  PreparationCacheOptions in_folder() const { return {.folder = folder_}; }
  /// A cache that has nothing in memory.
  DistanceField ask() const { return PreparationCache(in_folder()).object_field(object_, small_options()); }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
    return found;
  }

  fs::path folder_;
  ObjectModel object_ = torus();
  DistanceField fresh_ = make_object_field(object_, small_options());
};

TEST(ContentHash, VsPublishedValuesOfMurmurHash3) {
  EXPECT_EQ(content_hash(""), "00000000000000000000000000000000");
  EXPECT_EQ(content_hash("hello"), "cbd8a7b341bd9b025b1e906a48ae1d19");
  EXPECT_EQ(content_hash("The quick brown fox jumps over the lazy dog"), "e34bbc7bbc071b6c7a433ca9c49a9347");
}

TEST(RescaledObject, HasTheFieldOfItsMeshVsExactDistances) {
  RandomStream random{1};
  const ObjectModel object = torus();
  for (const double factor : {0.5, 0.75, 1.5, 2.0}) {
    const ObjectModel other = rescaled(object, factor);
    EXPECT_EQ(other.content_key, object.content_key);
    EXPECT_NEAR(other.max_radius, factor * object.max_radius, 1e-12);
    EXPECT_EQ(rescaled(other, 1.0 / factor).scale, 1.0);
    const DistanceField field = make_object_field(other, {});
    const DistanceField anew(other.bvh);
    const double cell = factor * field.fine().cell;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = testing::any_point(random, other.bvh.box(), factor * 0.015);
      const double exact = other.bvh.signed_distance(p);
      EXPECT_NEAR(field.distance(p), exact, 0.5 * cell) << factor;
      EXPECT_NEAR(field.distance(p), anew.distance(p), 0.5 * (cell + anew.fine().cell)) << factor;
      const Vec3 h = 1e-7 * testing::random_direction(random);
      const FieldSample s = field.sample(p);
      EXPECT_EQ(s.distance, field.distance(p));
      EXPECT_NEAR(field.distance(p + h) - s.distance, s.gradient.dot(h), 3e-8);
    }
    const Vec3 far(1.0, 2.0, 3.0);
    EXPECT_FALSE(field.covers(far));
    EXPECT_NEAR(field.distance(far), other.bvh.signed_distance(far), 0.05);
  }
}

TEST_F(PreparationCacheTest, GivesWhatIsMadeAnew) {
  expect_same(ask(), fresh_);
  ASSERT_EQ(files().size(), 1U);
  expect_same(ask(), fresh_);
  const auto expect_equal = [](const std::vector<Sphere>& cached, const std::vector<Sphere>& spheres) {
    ASSERT_EQ(cached.size(), spheres.size());
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      EXPECT_EQ(cached[k].center, spheres[k].center);
      EXPECT_EQ(cached[k].radius, spheres[k].radius);
    }
  };
  const auto spheres = cover_with_inner_spheres(object_.mesh, object_.bvh, 0.002);
  for (int i = 0; i < 2; ++i) {
    PreparationCache cache(in_folder());
    expect_equal(cache.inner_spheres(object_.mesh, object_.bvh, 0.002), spheres);
    expect_equal(cache.holding_spheres(object_.mesh, object_.bvh, 0.002), grow_to_hold(object_.bvh, spheres));
  }
  EXPECT_EQ(files().size(), 3U);
}

TEST_F(PreparationCacheTest, OneFieldServesAllScalesButNotOtherMeshesOrOptions) {
  PreparationCache cache(in_folder());
  const DistanceField small = cache.object_field(rescaled(object_, 0.75), small_options());
  const DistanceField large = cache.object_field(rescaled(object_, 1.5), small_options());
  EXPECT_EQ(small.grids(), large.grids());
  EXPECT_EQ(small.scale(), 0.75);
  expect_same(small.scaled(1.0 / 0.75), fresh_);
  EXPECT_EQ(files().size(), 1U);
  DistanceFieldOptions other = small_options();
  other.cell = 0.005;
  EXPECT_EQ(cache.object_field(object_, other).fine().cell, 0.005);
  const ObjectModel ball = make_object("ball", testing::ball_mesh(0.03, 8));
  expect_same(cache.object_field(ball, small_options()), make_object_field(ball, small_options()));
  EXPECT_EQ(files().size(), 3U);
}

TEST_F(PreparationCacheTest, DamagedFilesAreMadeAnew) {
  ask();
  const fs::path file = files().front();
  const std::string whole = read_text_file(file);
  std::vector<std::string> bad = {"", "x", whole + "x"};
  for (std::size_t k = 0; k < 16; ++k) bad.push_back(whole.substr(0, k * whole.size() / 16));
  RandomStream random{2};
  for (int i = 0; i < 40; ++i) {
    std::string flipped = whole;
    // Half of them in the header.
    const std::size_t size = i % 2 == 0 ? 120 : whole.size();
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(size));
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (i % 8)));
    bad.push_back(flipped);
  }
  std::string of_other_version = whole;
  ++of_other_version[16];
  bad.push_back(of_other_version);
  for (const std::string& content : bad) {
    std::ofstream(file, std::ios::binary) << content;
    expect_same(ask(), fresh_);
    EXPECT_TRUE(read_text_file(file) == whole) << "written anew";
  }
}

TEST_F(PreparationCacheTest, AFileOfAnotherKeyIsNotTaken) {
  ask();
  const fs::path torus_file = files().front();
  const ObjectModel ball = make_object("ball", testing::ball_mesh(0.03, 8));
  PreparationCache(in_folder()).object_field(ball, small_options());
  for (const fs::path& file : files())
    if (file != torus_file) fs::copy_file(torus_file, file, fs::copy_options::overwrite_existing);
  expect_same(PreparationCache(in_folder()).object_field(ball, small_options()),
              make_object_field(ball, small_options()));
}

TEST_F(PreparationCacheTest, WithoutAFolderOrAWritableOneItWorksOn) {
  expect_same(PreparationCache({}).object_field(object_, small_options()), fresh_);
  std::ofstream(folder_) << "a file where the folder should be";
  std::vector<std::string> said;
  PreparationCacheOptions options = in_folder();
  options.log = [&](const std::string& sentence) { said.push_back(sentence); };
  PreparationCache cache(options);
  expect_same(cache.object_field(object_, small_options()), fresh_);
  cache.inner_spheres(object_.mesh, object_.bvh, 0.002);
  ASSERT_EQ(said.size(), 1U) << "once";
  EXPECT_NE(said[0].find("not kept"), std::string::npos);
  fs::remove(folder_);
  if (::geteuid() == 0) return;  // who may write everywhere
  fs::create_directory(folder_);
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  expect_same(ask(), fresh_);
}

TEST_F(PreparationCacheTest, WritersSideBySide) {
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i)
    writers.emplace_back([&] {
      for (int k = 0; k < 5; ++k) {
        expect_same(ask(), fresh_);
        std::error_code ec;
        if (k % 2 == 0) fs::remove_all(folder_, ec);
      }
    });
  for (std::thread& t : writers) t.join();
  expect_same(ask(), fresh_);
  EXPECT_EQ(files().size(), 1U) << "nothing half-written stays";
}

TEST_F(PreparationCacheTest, TheFilesUnusedLongestAreRemoved) {
  ask();
  const auto bytes = fs::file_size(files().front());
  std::ofstream(folder_ / "of somebody else") << std::string(2 * bytes, 'x');
  PreparationCacheOptions options = in_folder();
  options.max_bytes = 5 * bytes / 2;
  PreparationCache cache(options);
  for (int i = 1; i < 4; ++i) {
    ObjectModel other = object_;
    other.content_key = fmt::format("other {}", i);
    cache.object_field(other, small_options());
    ask();  // used again and again
  }
  EXPECT_EQ(files().size(), 3U) << "two fields and what is not ours";
  expect_same(ask(), fresh_);
  EXPECT_TRUE(fs::exists(folder_ / "of somebody else"));
}

}  // namespace
}  // namespace eigengrasp
