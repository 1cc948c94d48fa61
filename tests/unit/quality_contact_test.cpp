// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// What a contact brings into the wrench space: friction, tangents, torsion length, edges.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "eigengrasp/contact/material.hpp"
#include "support/random_contacts.hpp"

namespace eigengrasp {
namespace {

TEST(FrictionTable, IsGraspIts) {
  EXPECT_EQ(table_friction("plastic", "glass"), 0.2);
  EXPECT_EQ(table_friction("wood", "plastic"), 0.4);
  EXPECT_EQ(table_friction("rubber", "stone"), 1.5);
  EXPECT_EQ(table_friction("rubber", "rubber"), 2.0);
  EXPECT_EQ(table_friction("stone", "stone"), 0.7);
  EXPECT_EQ(table_friction("frictionless", "rubber"), 0.0);
  EXPECT_EQ(table_friction("rubber", "frictionless"), 0.0);
}

TEST(FrictionTable, IsSymmetricAndTakesUnknownForWood) {
  for (const char* a : {"glass", "metal", "wood", "plastic", "rubber", "stone", "frictionless"}) {
    for (const char* b : {"glass", "metal", "wood", "plastic", "rubber", "stone", "frictionless"}) {
      EXPECT_EQ(table_friction(a, b), table_friction(b, a)) << a << " " << b;
    }
    EXPECT_EQ(table_friction(a, "cheese"), table_friction(a, "wood"));
    EXPECT_EQ(table_friction("", a), table_friction("wood", a));
  }
}

TEST(ContactFriction, HandWinsOverObjectOverTable) {
  const Material rubber{"rubber", {}, {}};
  const Material glass{"glass", {}, {}};
  EXPECT_EQ(contact_friction(rubber, glass), 1.0);
  EXPECT_EQ(contact_friction(rubber, {"glass", 0.7, {}}), 0.7);
  EXPECT_EQ(contact_friction({"rubber", 0.1, {}}, {"glass", 0.7, {}}), 0.1);
}

TEST(ContactTangents, AreARightHandedFrameForAnyNormal) {
  RandomStream random{1};
  for (int i = 0; i < 1000; ++i) {
    Vec3 n = testing::random_direction(random);
    if (i % 3 == 0) n[i % 2] *= 1e-9;
    if (i < 6) n = (i % 2 ? 1.0 : -1.0) * Vec3::Unit(i / 2);
    n.normalize();
    const auto [t1, t2] = contact_tangents(n);
    Mat3 frame;
    frame << t1, t2, n;
    EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-14);
  }
}

TEST(SoftFinger, TorsionLengthByHand) {
  // Sphere of 10 mm: delta = sqrt(5 * 0.003 / (1.5e6 pi 0.01)), a = b = sqrt(2 delta 0.01), e = 8 a / 15.
  const double delta = std::sqrt(5.0 * 0.003 / (1.5e6 * std::numbers::pi * 0.01));
  EXPECT_NEAR(soft_finger_torsion_length(100.0, 100.0, 1.5e6), 8.0 / 15.0 * std::sqrt(0.02 * delta), 1e-15);
}

TEST(SoftFinger, DegenerateRadiiAreTwentyMillimetres) {
  const double flat = soft_finger_torsion_length(50.0, 50.0, 1.5e6);
  for (const double k : {0.0, 1.0, -30.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(soft_finger_torsion_length(k, k, 1.5e6), flat) << k;
  }
  EXPECT_LT(soft_finger_torsion_length(50.0, 200.0, 1.5e6), flat);
  EXPECT_LT(flat, soft_finger_torsion_length(50.0, 50.0, 1e5));
}

// What the limit surface of contact_point.hpp allows, asked of a wrench.
double limit_surface(const ContactPoint& c, const WrenchSpaceOptions& o, const Vec6& w) {
  const Vec3 force = w.head<3>();
  const double normal_force = force.dot(c.n_OC);
  const Vec3 rest = w.tail<3>() * o.torque_scale - (c.p_OC - o.torque_origin_O).cross(force);
  EXPECT_NEAR(normal_force, 1.0, 1e-13);
  EXPECT_LT(rest.cross(c.n_OC).norm(), 1e-14);
  const double tangential = (force - normal_force * c.n_OC).squaredNorm() / (c.mu * c.mu);
  const double spin = rest.dot(c.n_OC);
  if (c.torsion_length == 0.0) return tangential + (std::abs(spin) < 1e-14 ? 0.0 : 1e9);
  return tangential + spin * spin / std::pow(c.mu * c.torsion_length, 2);
}

TEST(EdgeWrenches, LieOnTheLimitSurface) {
  auto options = testing::hand_options();
  options.torque_origin_O = Vec3(0.01, -0.02, 0.005);
  for (const double e : {0.0, 1e-4, 0.002}) {
    for (const ContactPoint& c : testing::random_contacts(20, 0.7, e, 9)) {
      const auto wrenches = testing::edge_wrenches({c}, options);
      EXPECT_EQ(wrenches.size(), e > 0.0 ? 20u : 8u);
      for (const Vec6& w : wrenches) EXPECT_NEAR(limit_surface(c, options, w), 1.0, 1e-9);
    }
  }
}

TEST(EdgeWrenches, BeginAtTheFirstTangent) {
  const ContactPoint c = testing::random_contacts(1, 0.5, 0.0, 4)[0];
  const Vec6 first = testing::edge_wrenches({c}, {})[0];
  EXPECT_LT((first.head<3>() - c.n_OC - 0.5 * contact_tangents(c.n_OC)[0]).norm(), 1e-15);
}

}  // namespace
}  // namespace eigengrasp
