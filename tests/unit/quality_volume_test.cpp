// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include <cmath>

#include "support/qhull_epsilon.hpp"
#include "support/random_contacts.hpp"

namespace eigengrasp {
namespace {

std::vector<Vec6> cube(double half_width) {
  std::vector<Vec6> wrenches;
  for (int i = 0; i < 64; ++i) {
    Vec6 w;
    for (int k = 0; k < 6; ++k) w[k] = (i >> k) & 1 ? half_width : -half_width;
    wrenches.push_back(w);
  }
  return wrenches;
}

TEST(HullVolume, CubeAndCrossPolytope) {
  EXPECT_NEAR(compute_hull_volume(cube(0.5)), 1.0, 1e-8);
  EXPECT_NEAR(compute_hull_volume(cube(1.0)), 64.0, 1e-6);
  std::vector<Vec6> cross;
  for (int k = 0; k < 6; ++k) {
    cross.push_back(Vec6::Unit(k));
    cross.push_back(-Vec6::Unit(k));
  }
  EXPECT_NEAR(compute_hull_volume(cross), 64.0 / 720.0, 1e-9);
}

TEST(HullVolume, DegenerateSetsAreZeroAndSilent) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(compute_hull_volume({}), 0.0);
  EXPECT_EQ(compute_hull_volume(std::vector<Vec6>(20, Vec6::Ones())), 0.0);
  auto flat = cube(1.0);
  for (Vec6& w : flat) w[3] = 0.25;
  EXPECT_EQ(compute_hull_volume(flat), 0.0);
  for (const int n : {0, 1, 2}) {
    EXPECT_EQ(compute_volume(testing::random_contacts(n, 0.0, 0.0, 5), testing::hand_options()), 0.0);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(HullVolume, ScalesWithTheSixthPowerAndMovesAlong) {
  const auto options = testing::hand_options();
  auto wrenches = testing::edge_wrenches(testing::random_contacts(5, 0.5, 0.0, 2), options);
  const double volume = compute_hull_volume(wrenches);
  EXPECT_GT(volume, 0.0);
  for (Vec6& w : wrenches) w = 2.0 * w + Vec6::Ones();
  EXPECT_NEAR(compute_hull_volume(wrenches), 64.0 * volume, 1e-6 * volume);
}

TEST(WrenchSpaceVolume, GrowsWithEdgesContactsAndForceBudget) {
  auto options = testing::hand_options();
  const auto contacts = testing::random_contacts(4, 0.5, 0.0, 4);
  const double eight = compute_volume(contacts, options);
  options.edges = 16;
  EXPECT_GT(compute_volume(contacts, options), eight);
  options.edges = 8;
  EXPECT_GE(compute_volume(testing::random_contacts(6, 0.5, 0.0, 4), options), eight);
}

TEST(WrenchSpaceVolume, LinfIsTheVolumeOfTheMinkowskiSum) {
  auto options = testing::hand_options();
  options.norm = WrenchNorm::linf;
  options.edges = 4;
  const auto contacts = testing::random_contacts(3, 0.5, 0.0, 4);
  std::vector<Vec6> sum(1, Vec6::Zero());
  for (const ContactPoint& c : contacts) {
    std::vector<Vec6> next = sum;
    for (const Vec6& w : testing::edge_wrenches({c}, options)) {
      for (const Vec6& v : sum) next.push_back(v + w);
    }
    sum = std::move(next);
  }
  const double expected = compute_hull_volume(sum);
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(compute_volume(contacts, options), expected, 1e-7 * expected);
}

TEST(WrenchSpaceVolume, AgreesWithQhullOnGraspsOfManyContacts) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto wrenches = testing::edge_wrenches(
        testing::random_contacts(4 + static_cast<int>(seed), 0.4, 0.0, seed), testing::hand_options());
    const double expected = testing::volume_by_qhull(wrenches);
    ASSERT_GT(expected, 0.0);
    EXPECT_NEAR(compute_hull_volume(wrenches), expected, 1e-7 * expected) << "seed " << seed;
  }
}

}  // namespace
}  // namespace eigengrasp
