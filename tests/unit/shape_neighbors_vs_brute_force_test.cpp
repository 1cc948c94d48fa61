// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/core/temporary_folder.hpp"
#include "eigengrasp/shape/nearest_shapes.hpp"
#include "eigengrasp/shape/shape_index.hpp"

namespace eigengrasp::testing {
namespace {

constexpr std::size_t dimension = 121;

std::vector<float> random_descriptor(RandomStream& stream) {
  std::vector<float> d;
  const double along = stream.uniform(), across = stream.uniform();  // of few dimensions, as shapes are
  for (std::size_t i = 0; i < dimension; ++i)
    d.push_back(static_cast<float>(std::sin(0.1 * static_cast<double>(i) * (1.0 + along)) + across +
                                   0.05 * stream.normal()));
  return d;
}

NearestShapes random_shapes(std::size_t count) {
  NearestShapes shapes(dimension);
  RandomStream stream{1};
  while (shapes.size() < count) shapes.add(random_descriptor(stream));
  return shapes;
}

TEST(NearestShapes, VsBruteForceInDoublePrecision) {
  const NearestShapes shapes = random_shapes(500);
  RandomStream stream{2};
  for (int q = 0; q < 20; ++q) {
    const auto query = random_descriptor(stream);
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const auto other = shapes.descriptor(i);
      double sum = 0.0;
      for (std::size_t k = 0; k < dimension; ++k)
        sum += std::pow(static_cast<double>(query[k]) - other[k], 2);
      all.emplace_back(std::sqrt(sum), i);
    }
    std::sort(all.begin(), all.end());
    const auto nearest = shapes.find_nearest(query, 10);
    ASSERT_EQ(nearest.size(), 10U);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      EXPECT_EQ(nearest[i].index, all[i].second);
      EXPECT_NEAR(nearest[i].distance, all[i].first, 1e-5);
    }
  }
}

TEST(NearestShapes, EqualOnesComeByIndexAndFewerThanAskedIsFine) {
  NearestShapes shapes(3);
  for (int i = 0; i < 4; ++i) shapes.add({1.0F, 2.0F, 3.0F});
  const auto nearest = shapes.find_nearest({1.0F, 2.0F, 3.0F}, 9);
  ASSERT_EQ(nearest.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(nearest[i], (NearShape{i, 0.0}));
  EXPECT_TRUE(NearestShapes(3).find_nearest({1.0F, 2.0F, 3.0F}, 5).empty());
}

TEST(NearestShapes, RefuseOtherSizesAndNumbersThatAreNotFinite) {
  NearestShapes shapes(3);
  EXPECT_THROW(shapes.add({1.0F}), Error);
  EXPECT_THROW(shapes.add({1.0F, 2.0F, std::numeric_limits<float>::quiet_NaN()}), Error);
  EXPECT_THROW(shapes.find_nearest({1.0F, 2.0F}, 1), Error);
}

double recall_of(const ShapeIndex& index, const NearestShapes& shapes) {
  RandomStream stream{3};
  int hits = 0;
  for (int q = 0; q < 50; ++q) {
    const auto query = random_descriptor(stream);
    const auto exact = shapes.find_nearest(query, 10);
    for (const NearShape& near : index.find_nearest(query, 10))
      hits += static_cast<int>(std::count_if(exact.begin(), exact.end(),
                                             [&](const NearShape& e) { return e.index == near.index; }));
  }
  return hits / 500.0;
}

TEST(ShapeIndex, FindsWhatBruteForceFindsAlsoWhenReadAgain) {
  const NearestShapes shapes = random_shapes(3000);
  const ShapeIndex index(shapes);
  EXPECT_EQ(index.size(), 3000U);
  EXPECT_GE(recall_of(index, shapes), 0.95);
  const TemporaryFolder folder("shape-index");
  index.save(folder.path() / "shapes.index");
  const ShapeIndex again = ShapeIndex::load(folder.path() / "shapes.index");
  EXPECT_EQ(again.dimension(), dimension);
  RandomStream stream{4};
  const auto query = random_descriptor(stream);
  EXPECT_EQ(again.find_nearest(query, 25), index.find_nearest(query, 25));
  EXPECT_EQ(ShapeIndex(shapes).find_nearest(query, 25), index.find_nearest(query, 25));  // made again
}

TEST(ShapeIndex, DamagedFilesAreRefused) {
  const TemporaryFolder folder("shape-index");
  const auto file = folder.path() / "shapes.index";
  EXPECT_THROW(ShapeIndex::load(file), Error);
  ShapeIndex(random_shapes(50)).save(file);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(ShapeIndex::load(file), Error);
  std::ofstream(file.string() + ".sum") << "something else";
  EXPECT_THROW(ShapeIndex::load(file), Error);
  EXPECT_THROW(ShapeIndex(NearestShapes(dimension)), Error);
  ShapeIndexOptions options;
  options.links = 1;
  EXPECT_EQ(options.validate().size(), 1U);
  EXPECT_THROW(ShapeIndex(random_shapes(5), options), Error);
}

}  // namespace
}  // namespace eigengrasp::testing
