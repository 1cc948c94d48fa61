// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Epsilon by the expanding polytope against the whole hull by Qhull: random sets, and the degenerate ones on
// purpose.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/qhull_epsilon.hpp"
#include "support/random_contacts.hpp"

namespace eigengrasp {
namespace {

using testing::edge_wrenches;
using testing::epsilon_by_qhull;
using testing::hand_options;
using testing::random_contacts;

void expect_as_qhull(const std::vector<Vec6>& wrenches, double tolerance, std::uint64_t seed) {
  const double expected = epsilon_by_qhull(wrenches);
  const double epsilon = compute_epsilon(wrenches).epsilon;
  EXPECT_NEAR(epsilon, expected, tolerance) << "seed " << seed << ", " << wrenches.size() << " wrenches";
}

std::vector<Vec6> random_wrenches(int n, std::uint64_t seed) {
  RandomStream random{seed, 0xE};
  std::vector<Vec6> wrenches(static_cast<std::size_t>(n));
  for (Vec6& w : wrenches) {
    for (int k = 0; k < 6; ++k) w[k] = random.normal();
  }
  return wrenches;
}

TEST(EpsilonVsQhull, RandomWrenchesAgreeTo1e9Relative) {
  double worst = 0.0;
  int inside = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto wrenches = random_wrenches(7 + static_cast<int>(seed % 40), seed);
    const double expected = epsilon_by_qhull(wrenches);
    const double epsilon = compute_epsilon(wrenches).epsilon;
    ASSERT_NEAR(epsilon, expected, 1e-9 * expected + 1e-14) << "seed " << seed;
    if (expected > 0.0) {
      ++inside;
      worst = std::max(worst, std::abs(epsilon - expected) / expected);
    }
  }
  EXPECT_GT(inside, 100);
  RecordProperty("worst_relative", std::to_string(worst));
}

TEST(EpsilonVsQhull, PointContacts) {
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    const auto contacts =
        random_contacts(2 + static_cast<int>(seed % 9), 0.2 + 0.1 * double(seed % 8), 0, seed);
    expect_as_qhull(edge_wrenches(contacts, hand_options()), 1e-9, seed);
  }
}

TEST(EpsilonVsQhull, SoftContacts) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto contacts = random_contacts(1 + static_cast<int>(seed % 6), 0.5, 0.003, seed);
    expect_as_qhull(edge_wrenches(contacts, hand_options()), 1e-8, seed);
  }
}

TEST(EpsilonVsQhull, RepeatedContacts) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    auto contacts = random_contacts(5, 0.5, 0.0, seed);
    for (int copy = 0; copy < 2; ++copy)
      contacts.insert(contacts.end(), contacts.begin(), contacts.begin() + 4);
    expect_as_qhull(edge_wrenches(contacts, hand_options()), 1e-9, seed);
  }
}

TEST(EpsilonVsQhull, NearlyRepeatedContacts) {
  for (std::uint64_t seed = 0; seed < 26; ++seed) {
    auto contacts = random_contacts(5, 0.5, 0.0, seed);
    const double shift = std::pow(10.0, -3.0 - double(seed % 13));
    for (int i = 0; i < 5; ++i) {
      contacts.push_back(contacts[static_cast<std::size_t>(i)]);
      contacts.back().p_OC.x() += shift;
    }
    expect_as_qhull(edge_wrenches(contacts, hand_options()), 1e-6, seed);
  }
}

TEST(EpsilonVsQhull, FrictionlessContacts) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    expect_as_qhull(edge_wrenches(random_contacts(12, 0.0, 0.0, seed), hand_options()), 1e-9, seed);
  }
}

TEST(EpsilonVsQhull, ContactsInAPlane) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    auto contacts = random_contacts(3 + static_cast<int>(seed % 6), 0.6, seed % 2 ? 0.002 : 0.0, seed);
    for (ContactPoint& c : contacts) {
      c.p_OC.z() = 0.0;
      c.n_OC.z() = 0.0;
      c.n_OC.normalize();
    }
    expect_as_qhull(edge_wrenches(contacts, hand_options()), 1e-8, seed);
  }
}

TEST(EpsilonVsQhull, AlignedGridsWithManyCoplanarWrenches) {
  // Contacts on a box grid: normals along the axes, so that whole families of edges are coplanar.
  for (int per_side = 1; per_side <= 2; ++per_side) {
    std::vector<ContactPoint> contacts;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i < per_side; ++i) {
          for (int j = 0; j < per_side; ++j) {
            ContactPoint c;
            c.mu = 0.5;
            c.n_OC = -side * Vec3::Unit(axis);
            c.p_OC[axis] = side;
            c.p_OC[(axis + 1) % 3] = i - 0.5 * (per_side - 1);
            c.p_OC[(axis + 2) % 3] = j - 0.5 * (per_side - 1);
            contacts.push_back(c);
          }
        }
      }
    }
    expect_as_qhull(edge_wrenches(contacts, {}), 1e-8, static_cast<std::uint64_t>(per_side));
  }
}

// Positions on a grid of three, normals along few directions, some contacts mirrored, torsion from none to
// huge.
std::vector<ContactPoint> grid_contacts(std::uint64_t seed) {
  RandomStream random{seed, 77};
  const auto pick = [&](int n) { return static_cast<int>(random.uniform() * n); };
  const int n = 1 + pick(9);
  const double mu = std::array{0.0, 0.5, 1.0, 0.3}[static_cast<std::size_t>(pick(4))];
  const double e = std::array{0.0, 0.0, 0.5, 1e-3}[static_cast<std::size_t>(pick(4))];
  std::vector<ContactPoint> contacts;
  for (int i = 0; i < n; ++i) {
    ContactPoint c;
    for (int k = 0; k < 3; ++k) c.p_OC[k] = pick(3) - 1;
    c.n_OC = (pick(2) ? 1.0 : -1.0) * Vec3::Unit(pick(3));
    if (pick(3) == 0) c.n_OC = Vec3(pick(3) - 1, pick(3) - 1, 1).normalized();
    c.mu = mu;
    c.torsion_length = e;
    contacts.push_back(c);
    if (pick(5) < 2) {
      c.p_OC = -c.p_OC;
      c.n_OC = -c.n_OC;
      contacts.push_back(c);
    }
  }
  return contacts;
}

TEST(EpsilonVsQhull, ContactsOnAGrid) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    WrenchSpaceOptions options;
    options.edges = seed % 2 ? 8 : 4;
    expect_as_qhull(edge_wrenches(grid_contacts(seed), options), 2e-9, seed);
  }
}

TEST(EpsilonVsQhull, NearlyFlatHullsKeep1e6Absolute) {
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    auto wrenches = random_wrenches(40, seed);
    const double thickness = std::pow(10.0, -1.0 - double(seed % 15));
    for (Vec6& w : wrenches) w[static_cast<int>(seed % 6)] *= thickness;
    if (seed % 2) {
      for (Vec6& w : wrenches) w[static_cast<int>((seed + 1) % 6)] *= thickness;
    }
    expect_as_qhull(wrenches, 1e-6, seed);
  }
}

TEST(EpsilonVsQhull, WrenchesRoundedToSixDigits) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    auto wrenches = edge_wrenches(random_contacts(6, 0.5, seed % 2 ? 0.002 : 0.0, seed), hand_options());
    for (Vec6& w : wrenches) {
      for (int k = 0; k < 6; ++k) w[k] = std::round(w[k] * 1e6) * 1e-6;
    }
    expect_as_qhull(wrenches, 1e-8, seed);
  }
}

TEST(EpsilonVsQhull, TwoHundredContacts) {
  auto options = hand_options();
  options.edges = 3;  // for Qhull's sake
  expect_as_qhull(edge_wrenches(random_contacts(200, 0.5, 0.0, 1), options), 1e-8, 1);
}

TEST(EpsilonVsQhull, LinfOfExplicitMinkowskiSum) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const int n = 2 + static_cast<int>(seed % 3);
    auto options = hand_options();
    options.edges = n == 4 ? 4 : 6;
    const auto contacts = random_contacts(n, 0.9, 0.0, seed);
    std::vector<Vec6> sum(1, Vec6::Zero());
    for (const ContactPoint& c : contacts) {
      std::vector<Vec6> next = sum;
      for (const Vec6& w : edge_wrenches({c}, options)) {
        for (const Vec6& v : sum) next.push_back(v + w);
      }
      sum = std::move(next);
    }
    options.norm = WrenchNorm::linf;
    EXPECT_NEAR(compute_epsilon(contacts, options).epsilon, epsilon_by_qhull(sum), 1e-8) << "seed " << seed;
  }
}

}  // namespace
}  // namespace eigengrasp
