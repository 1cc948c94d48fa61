// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Laws of epsilon that hold for any contacts: true cones against many edges, rigid motion, monotony, limits.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/random_contacts.hpp"

namespace eigengrasp {
namespace {

using testing::hand_options;
using testing::random_contacts;

double exact_epsilon(const std::vector<ContactPoint>& contacts, WrenchNorm norm = WrenchNorm::l1) {
  auto options = hand_options();
  options.cone = ConeModel::exact;
  options.norm = norm;
  options.tolerance = 1e-9;
  return compute_epsilon(contacts, options).epsilon;
}

TEST(ExactCone, ManyEdgesConvergeFromBelow) {
  int closed = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    const auto contacts = random_contacts(3 + static_cast<int>(seed % 5), 0.6, 0.0, seed);
    for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf}) {
      const double exact = exact_epsilon(contacts, norm);
      auto options = hand_options();
      options.norm = norm;
      // Doubling keeps the old edges, so epsilon can only grow.
      double last = 0.0;
      for (options.edges = 4; options.edges <= 256; options.edges *= 2) {
        const double epsilon = compute_epsilon(contacts, options).epsilon;
        EXPECT_GE(epsilon, last - 1e-9) << "seed " << seed << ", edges " << options.edges;
        EXPECT_LE(epsilon, exact + 1e-8) << "seed " << seed << ", edges " << options.edges;
        last = epsilon;
      }
      // The polygon of 256 edges is 7.5e-5 mu inside the circle; in a wrench space that is a lever of some
      // size.
      EXPECT_NEAR(last, exact, 1e-3) << "seed " << seed;
      closed += exact > 0.0;
    }
  }
  EXPECT_GT(closed, 10);
}

TEST(ExactCone, SoftEdgesAreInsideOfTheEllipsoid) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    const auto contacts = random_contacts(2 + static_cast<int>(seed % 5), 0.6, 0.003, seed);
    EXPECT_LE(compute_epsilon(contacts, hand_options()).epsilon, exact_epsilon(contacts) + 1e-8) << seed;
  }
}

TEST(ExactCone, RigidMotionWithItsOriginChangesNothing) {
  RandomStream random{7};
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    const auto contacts = random_contacts(5, 0.5, seed % 2 ? 0.002 : 0.0, seed);
    const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
    const Pose X = make_pose(q, Vec3(random.normal(), random.normal(), random.normal()));
    auto moved = contacts;
    for (ContactPoint& c : moved) {
      c.p_OC = X * c.p_OC;
      c.n_OC = X.linear() * c.n_OC;
    }
    auto options = hand_options();
    options.cone = ConeModel::exact;
    options.tolerance = 1e-9;
    const double here = compute_epsilon(contacts, options).epsilon;
    options.torque_origin_O = X.translation();
    EXPECT_NEAR(compute_epsilon(moved, options).epsilon, here, 5e-9) << seed;
  }
}

TEST(ExactCone, LengthUnitCancels) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    auto contacts = random_contacts(5, 0.5, 0.002, seed);
    auto options = hand_options();
    options.cone = ConeModel::exact;
    options.tolerance = 1e-9;
    const double metres = compute_epsilon(contacts, options).epsilon;
    for (ContactPoint& c : contacts) {
      c.p_OC *= 1000.0;
      c.torsion_length *= 1000.0;
    }
    options.torque_scale *= 1000.0;
    EXPECT_NEAR(compute_epsilon(contacts, options).epsilon, metres, 3e-9) << seed;
  }
}

TEST(ExactCone, MoreContactsAndMoreFrictionNeverHurt) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const auto all = random_contacts(8, 0.5, 0.0, seed);
    for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf}) {
      double last = 0.0;
      for (std::ptrdiff_t n = 3; n <= 8; ++n) {
        const double epsilon = exact_epsilon({all.begin(), all.begin() + n}, norm);
        EXPECT_GE(epsilon, last - 5e-9) << "seed " << seed << ", contacts " << n;
        last = epsilon;
      }
      last = 0.0;
      auto some = std::vector<ContactPoint>(all.begin(), all.begin() + 5);
      for (double mu = 0.0; mu <= 1.5; mu += 0.25) {
        for (ContactPoint& c : some) c.mu = mu;
        const double epsilon = exact_epsilon(some, norm);
        EXPECT_GE(epsilon, last - 5e-9) << "seed " << seed << ", mu " << mu;
        last = epsilon;
      }
    }
  }
}

TEST(ExactCone, SumOfCapsContainsTheUnion) {
  // Each normal force at most 1 allows at least what a sum of at most 1 allows.
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const auto contacts = random_contacts(5, 0.5, 0.001, seed);
    EXPECT_GE(exact_epsilon(contacts, WrenchNorm::linf), exact_epsilon(contacts) - 5e-9) << seed;
  }
}

TEST(ExactCone, SoftFingerWithoutTorsionIsAPointContact) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const double point = exact_epsilon(random_contacts(5, 0.5, 0.0, seed));
    for (const double e : {1e-6, 1e-9, 1e-12}) {
      // Torques of mu e / scale are all that is added.
      EXPECT_NEAR(exact_epsilon(random_contacts(5, 0.5, e, seed)), point, 0.5 * e / 0.05 + 5e-9) << seed;
    }
  }
}

TEST(ExactCone, EqualCopiesAddUpInLinf) {
  const auto once = random_contacts(4, 0.8, 0.002, 3);
  auto twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_NEAR(exact_epsilon(twice, WrenchNorm::linf), 2.0 * exact_epsilon(once, WrenchNorm::linf), 1e-8);
  EXPECT_NEAR(exact_epsilon(twice), exact_epsilon(once), 5e-9);
}

}  // namespace
}  // namespace eigengrasp
