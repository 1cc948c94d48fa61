// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The early decision against the number that it stands for.
#include <gtest/gtest.h>

#include "support/random_contacts.hpp"

namespace eigengrasp {
namespace {

using testing::hand_options;
using testing::random_contacts;

void expect_same_decision(const std::vector<ContactPoint>& contacts, const WrenchSpaceOptions& options,
                          std::uint64_t seed, int& closed) {
  const WrenchSpaceQuality quality = compute_epsilon(contacts, options);
  EXPECT_EQ(quality.form_closure, quality.epsilon >= options.epsilon_min) << "seed " << seed;
  EXPECT_EQ(has_form_closure(contacts, options), quality.form_closure)
      << "seed " << seed << ", contacts " << contacts.size() << ", epsilon " << quality.epsilon;
  closed += quality.form_closure;
}

TEST(FormClosure, IsEpsilonAboveItsMinimumOnThousandsOfSets) {
  int closed = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const double mu = 0.1 * static_cast<double>(seed % 10);
    const double torsion = seed % 3 == 0 ? 0.002 : 0.0;
    const auto contacts = random_contacts(static_cast<int>(seed % 9), mu, torsion, seed);
    expect_same_decision(contacts, hand_options(), seed, closed);
  }
  EXPECT_GT(closed, 500);
}

TEST(FormClosure, ExactConesAndSums) {
  int closed = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    auto options = hand_options();
    options.cone = seed % 2 ? ConeModel::exact : ConeModel::edges;
    options.norm = seed % 4 < 2 ? WrenchNorm::linf : WrenchNorm::l1;
    const auto contacts = random_contacts(2 + static_cast<int>(seed % 4), 0.5, seed % 3 ? 0.0 : 0.002, seed);
    expect_same_decision(contacts, options, seed, closed);
  }
  EXPECT_GT(closed, 50);
}

TEST(FormClosure, MinimumJustAboveAndBelowEpsilon) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (const ConeModel cone : {ConeModel::edges, ConeModel::exact}) {
      auto options = hand_options();
      options.cone = cone;
      options.tolerance = 1e-9;
      const auto contacts = random_contacts(5, 0.6, 0.0, seed);
      const double epsilon = compute_epsilon(contacts, options).epsilon;
      if (epsilon < 1e-3) continue;
      options.epsilon_min = epsilon - 1e-7;
      EXPECT_TRUE(has_form_closure(contacts, options)) << "seed " << seed;
      options.epsilon_min = epsilon + 1e-7;
      EXPECT_FALSE(has_form_closure(contacts, options)) << "seed " << seed;
    }
  }
}

TEST(FormClosure, OriginOnTheBoundaryIsNotClosed) {
  // Three contacts on a great circle cannot turn about a pivot line that meets all of their cones; the hull
  // touches the origin from one side.
  std::vector<ContactPoint> contacts(2);
  contacts[0] = {Vec3(0.05, 0, 0), -Vec3::UnitX(), 0.5, 0.002};
  contacts[1] = {Vec3(0.0, 0.05, 0), Vec3::UnitX(), 0.0, 0.0};
  EXPECT_FALSE(has_form_closure(contacts, hand_options()));
  auto options = hand_options();
  options.epsilon_min = 0.0;
  EXPECT_FALSE(has_form_closure(contacts, options));
}

}  // namespace
}  // namespace eigengrasp
