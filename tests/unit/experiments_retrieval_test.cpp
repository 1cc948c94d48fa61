// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Measures of retrieval against ones that were worked out by hand.
#include "eigengrasp/experiments/retrieval.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigengrasp::testing {
namespace {

TEST(Retrieval, VsByHand) {
  NearestShapes shapes(1);  // on a line: a a b a b b, and one alone far off
  for (const float x : {0.0F, 1.0F, 2.1F, 3.3F, 4.6F, 6.0F, 99.0F}) shapes.add({x});
  const RetrievalMeasures m = measure_retrieval(shapes, {0, 0, 1, 0, 1, 1, 2});
  // Hits in the order of distance, of 6 others; each class has 2 others.
  // a0: 1 0 1 0 0 0   a1: 1 0 1 0 0 0   b2: 0 0 0 1 1 0
  // a3: 0 0 1 0 1 0   b4: 0 1 1 0 0 0   b5: 1 0 1 0 0 0
  EXPECT_EQ(m.queries, 6);
  EXPECT_NEAR(m.nearest_neighbor, 3.0 / 6.0, 1e-12);
  EXPECT_NEAR(m.first_tier, (0.5 + 0.5 + 0.0 + 0.0 + 0.5 + 0.5) / 6.0, 1e-12);
  EXPECT_NEAR(m.second_tier, (1.0 + 1.0 + 0.5 + 0.5 + 1.0 + 1.0) / 6.0, 1e-12);
  EXPECT_NEAR(m.e_measure, 2.0 * 2.0 / (6.0 + 2.0), 1e-12);  // lists shorter than 32: all are found
  const double three = 1.0 / std::log2(3.0), four = 0.5, five = 1.0 / std::log2(5.0);
  const double gains = 3 * (1.0 + three) + (four + five) + (1.0 + three) + (three + five);
  EXPECT_NEAR(m.dcg, gains / (6.0 * 2.0), 1e-12);
  EXPECT_NEAR(m.precision.back(), (4 * 2.0 / 3.0 + 2.0 / 5.0 + 2.0 / 5.0) / 6.0, 1e-12);
}

TEST(Retrieval, IsPerfectWhereClassesLieApart) {
  NearestShapes shapes(1);
  std::vector<int> classes;
  for (int i = 0; i < 12; ++i) {
    classes.push_back(i / 4);
    shapes.add({static_cast<float>(100 * (i / 4) + i)});
  }
  const RetrievalMeasures m = measure_retrieval(shapes, classes);
  EXPECT_EQ(m.nearest_neighbor, 1.0);
  EXPECT_EQ(m.first_tier, 1.0);
  EXPECT_EQ(m.second_tier, 1.0);
  EXPECT_NEAR(m.dcg, 1.0, 1e-12);
  for (const double p : m.precision) EXPECT_EQ(p, 1.0);
}

}  // namespace
}  // namespace eigengrasp::testing
