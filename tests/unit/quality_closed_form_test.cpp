// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Sets of wrenches and contacts whose epsilon is known by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "support/random_contacts.hpp"

namespace eigengrasp {
namespace {

TEST(EpsilonClosedForm, CrossPolytope) {
  std::vector<Vec6> wrenches;
  for (int k = 0; k < 6; ++k) {
    wrenches.push_back(Vec6::Unit(k));
    wrenches.push_back(-Vec6::Unit(k));
  }
  EXPECT_NEAR(compute_epsilon(wrenches).epsilon, 1.0 / std::sqrt(6.0), 1e-14);
  EXPECT_TRUE(compute_epsilon(wrenches).form_closure);
}

TEST(EpsilonClosedForm, CubeWithThirtyTwoWrenchesOnAFacet) {
  std::vector<Vec6> wrenches;
  for (int i = 0; i < 64; ++i) {
    Vec6 w;
    for (int k = 0; k < 6; ++k) w[k] = (i >> k) & 1 ? 1.0 : -1.0;
    wrenches.push_back(w);
  }
  EXPECT_NEAR(compute_epsilon(wrenches).epsilon, 1.0, 1e-14);
}

TEST(EpsilonClosedForm, ShiftedCrossPolytopeLosesTheOrigin) {
  for (const double shift : {0.0, 0.3, 0.999, 1.0, 1.001, 5.0}) {
    std::vector<Vec6> wrenches;
    for (int k = 0; k < 6; ++k) {
      for (const double sign : {-1.0, 1.0}) wrenches.push_back(sign * Vec6::Unit(k) + shift * Vec6::Unit(2));
    }
    const double expected = std::max(0.0, (1.0 - shift) / std::sqrt(6.0));
    EXPECT_NEAR(compute_epsilon(wrenches).epsilon, expected, 1e-13) << shift;
    EXPECT_EQ(compute_epsilon(wrenches).form_closure, shift < 0.9999) << shift;
  }
}

TEST(EpsilonClosedForm, TwoOpposingSoftFingersHoldLeastAgainstSpin) {
  // Torque about the line between the contacts is held by torsion alone: epsilon = mu e / scale, as long as
  // that is much less than the other resistances.
  for (const double e : {0.001, 0.002, 0.005}) {
    for (const double mu : {0.3, 1.0}) {
      std::vector<ContactPoint> contacts(2);
      contacts[0] = {Vec3(0.05, 0, 0), -Vec3::UnitX(), mu, e};
      contacts[1] = {Vec3(-0.05, 0, 0), Vec3::UnitX(), mu, e};
      auto options = testing::hand_options();
      options.cone = ConeModel::exact;
      EXPECT_NEAR(compute_epsilon(contacts, options).epsilon, mu * e / 0.05, 2e-6) << e << " " << mu;
      // Both may press with the whole force: the support function is 2 m |tau_x| as long as neither lets go,
      // which is |f_x| <= m |tau_x| with m = mu e / scale.
      options.norm = WrenchNorm::linf;
      const double m = mu * e / 0.05;
      const double expected = 2.0 * m / std::hypot(1.0, m);
      EXPECT_NEAR(compute_epsilon(contacts, options).epsilon, expected, 2e-6) << e << " " << mu;
    }
  }
}

TEST(EpsilonClosedForm, TwoOpposingPointContactsCannotHoldSpin) {
  std::vector<ContactPoint> contacts(2);
  contacts[0] = {Vec3(0.05, 0, 0), -Vec3::UnitX(), 1.0, 0.0};
  contacts[1] = {Vec3(-0.05, 0, 0), Vec3::UnitX(), 1.0, 0.0};
  for (const ConeModel cone : {ConeModel::edges, ConeModel::exact}) {
    for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf}) {
      auto options = testing::hand_options();
      options.cone = cone;
      options.norm = norm;
      EXPECT_LT(compute_epsilon(contacts, options).epsilon, 1e-12);
      EXPECT_FALSE(has_form_closure(contacts, options));
    }
  }
}

TEST(EpsilonClosedForm, TwentyFourFrictionlessContactsOnACube) {
  // Four a face, at distance a from its middle along the edges: the support function is
  // max over axes i of |f_i| + a max over j != i of |tau_j|, least where all |tau_j| are 1 / sqrt(3).
  for (const double a : {0.25, 0.5, 1.0}) {
    std::vector<ContactPoint> contacts;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        for (int other = 1; other <= 2; ++other) {
          for (const double sign : {-a, a}) {
            const Vec3 p = side * Vec3::Unit(axis) + sign * Vec3::Unit((axis + other) % 3);
            contacts.push_back({p, -side * Vec3::Unit(axis), 0.0, 0.0});
          }
        }
      }
    }
    for (const ConeModel cone : {ConeModel::edges, ConeModel::exact}) {
      WrenchSpaceOptions options;
      options.cone = cone;
      EXPECT_NEAR(compute_epsilon(contacts, options).epsilon, a / std::sqrt(3.0), 2e-6);
    }
  }
}

TEST(EpsilonClosedForm, SixFrictionlessContactsNeverClose) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (int n = 0; n <= 6; ++n) {
      const auto contacts = testing::random_contacts(n, 0.0, 0.0, seed);
      EXPECT_LT(compute_epsilon(contacts, testing::hand_options()).epsilon, 1e-12) << seed << " " << n;
      EXPECT_FALSE(has_form_closure(contacts, testing::hand_options()));
    }
  }
}

TEST(EpsilonClosedForm, TetrahedronBoundedByPureTorque) {
  // Four point contacts on the unit sphere: against a pure torque along an axis each holds mu sqrt(2/3).
  std::vector<ContactPoint> contacts;
  for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}) {
    contacts.push_back({corner.normalized(), -corner.normalized(), 0.4, 0.0});
  }
  WrenchSpaceOptions options;
  options.cone = ConeModel::exact;
  const double exact = compute_epsilon(contacts, options).epsilon;
  EXPECT_LE(exact, 0.4 * std::sqrt(2.0 / 3.0) + 1e-9);
  options.cone = ConeModel::edges;
  options.edges = 256;
  EXPECT_NEAR(exact, compute_epsilon(contacts, options).epsilon, 1e-3 * exact);
  EXPECT_GT(exact, 0.05);
}

TEST(EpsilonClosedForm, EmptySingleAndEqualContactsAreZero) {
  for (const ConeModel cone : {ConeModel::edges, ConeModel::exact}) {
    for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf}) {
      auto options = testing::hand_options();
      options.cone = cone;
      options.norm = norm;
      EXPECT_EQ(compute_epsilon(std::vector<ContactPoint>{}, options).epsilon, 0.0);
      for (const int copies : {1, 2, 200}) {
        for (const double e : {0.0, 0.003}) {
          const std::vector<ContactPoint> contacts(static_cast<std::size_t>(copies),
                                                   {Vec3(0.01, 0.02, 0.03), Vec3::UnitZ(), 0.5, e});
          EXPECT_LT(compute_epsilon(contacts, options).epsilon, 1e-12);
          EXPECT_FALSE(has_form_closure(contacts, options));
        }
      }
    }
  }
  EXPECT_EQ(compute_epsilon(std::vector<Vec6>{}).epsilon, 0.0);
  EXPECT_EQ(compute_epsilon(std::vector<Vec6>(9, Vec6::Zero())).epsilon, 0.0);
}

}  // namespace
}  // namespace eigengrasp
