// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Contacts of touching surfaces whose touching region is known.
#include <gtest/gtest.h>

#include <algorithm>

#include "eigengrasp/grasp/contact_finder.hpp"
#include "support/parallel_gripper.hpp"

namespace eigengrasp {
namespace {

using testing::at;
using testing::box_mesh;
using testing::exact_model;
using testing::pad;
using testing::scene_of;
using testing::solid;

constexpr double gap = 0.0001;

/// Contacts of a pad above a cube of 60 mm about the origin.
std::vector<GraspContact> contacts_on_cube(const TriangleMesh& mesh, const Pose& X_OL,
                                           const Material& material = {}) {
  return find_contacts(exact_model(scene_of(pad(mesh, material), solid(box_mesh({0.06, 0.06, 0.06})))),
                       {X_OL});
}

void expect_point(const std::vector<GraspContact>& contacts, const Vec3& p, double tolerance = 1e-6) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const GraspContact& c : contacts) nearest = std::min(nearest, (c.point.p_OC - p).norm());
  EXPECT_LT(nearest, tolerance) << "no contact at " << p.transpose();
}

TEST(FindContacts, ABoxOnABoxTouchesAtTheCornersOfTheOverlap) {
  const auto contacts = contacts_on_cube(box_mesh({0.02, 0.03, 0.01}), at(0.025, 0.0, 0.035 + gap));
  ASSERT_EQ(contacts.size(), 4u);
  for (const double x : {0.015, 0.030})
    for (const double y : {-0.015, 0.015}) expect_point(contacts, {x, y, 0.03});
  for (const GraspContact& c : contacts) {
    EXPECT_EQ(c.link, "pad");
    EXPECT_EQ(c.patch, 0);
    EXPECT_LT((c.point.n_OC + Vec3::UnitZ()).norm(), 1e-6) << "into the object";
    EXPECT_EQ(c.point.torsion_length, 0.0);
    EXPECT_EQ(c.point.mu, table_friction("", ""));
  }
}

TEST(FindContacts, EachSideOfTheObjectHasItsNormal) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Pose X = Pose::Identity();
      X.translation() = side * (0.04 + gap) * Vec3::Unit(axis);
      const auto contacts = contacts_on_cube(box_mesh({0.02, 0.02, 0.02}), X);
      ASSERT_EQ(contacts.size(), 4u);
      for (const GraspContact& c : contacts)
        EXPECT_LT((c.point.n_OC + side * Vec3::Unit(axis)).norm(), 1e-6) << axis << " " << side;
    }
}

TEST(FindContacts, ABallOnAPlaneTouchesInOnePoint) {
  const auto contacts = contacts_on_cube(testing::ball_mesh(0.01), at(0.004, -0.003, 0.04 + gap));
  ASSERT_EQ(contacts.size(), 1u);
  expect_point(contacts, {0.004, -0.003, 0.03}, 0.0005);
  EXPECT_LT((contacts[0].point.n_OC + Vec3::UnitZ()).norm(), 1e-6);
}

TEST(FindContacts, ALyingCapsuleTouchesInTheEndsOfALine) {
  const Pose lying =
      make_pose(Eigen::Quaterniond(std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0), {0.0, 0.0, 0.03 + 0.006 + gap});
  const auto contacts = contacts_on_cube(testing::capsule_mesh(0.006, 0.01), lying);
  // Its ends, and at most one more point of the strip that is nearer than the threshold.
  ASSERT_GE(contacts.size(), 2u);
  ASSERT_LE(contacts.size(), 3u);
  expect_point(contacts, {-0.01, 0.0, 0.03}, 1e-4);
  expect_point(contacts, {0.01, 0.0, 0.03}, 1e-4);
  for (const GraspContact& c : contacts) {
    EXPECT_EQ(c.patch, 0);
    EXPECT_LT((c.point.n_OC + Vec3::UnitZ()).norm(), 1e-3);
    EXPECT_LT(std::abs(c.point.p_OC.y()), 0.0012);
  }
  // Standing it touches in one.
  EXPECT_EQ(contacts_on_cube(testing::capsule_mesh(0.006, 0.01), at(0, 0, 0.03 + 0.016 + gap)).size(), 1u);
}

TEST(FindContacts, BeyondTheThresholdNothingTouches) {
  EXPECT_TRUE(contacts_on_cube(box_mesh({0.02, 0.02, 0.02}), at(0, 0, 0.0403)).empty());
  EXPECT_TRUE(contacts_on_cube(box_mesh({0.02, 0.02, 0.02}), at(0, 0, 0.5)).empty());
  EXPECT_FALSE(contacts_on_cube(box_mesh({0.02, 0.02, 0.02}), at(0, 0, 0.0401)).empty());
}

TEST(FindContacts, PointsAreNotCloserThanTheMergeDistance) {
  const auto contacts = contacts_on_cube(box_mesh({0.002, 0.02, 0.02}), at(0, 0, 0.04 + gap));
  EXPECT_EQ(contacts.size(), 2u);  // the region is 2 x 20 mm
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((contacts[i].point.p_OC - contacts[j].point.p_OC).norm(), ContactOptions().merge);
}

TEST(FindContacts, TwoRegionsOfALinkAreTwoPatches) {
  TriangleMesh feet = box_mesh({0.01, 0.01, 0.01}, {-0.02, 0.0, 0.0});
  append(feet, box_mesh({0.01, 0.01, 0.01}, {0.02, 0.0, 0.0}));
  const auto contacts = contacts_on_cube(feet, at(0, 0, 0.035 + gap));
  ASSERT_EQ(contacts.size(), 8u);
  for (const GraspContact& a : contacts)
    for (const GraspContact& b : contacts)
      EXPECT_EQ(a.patch == b.patch, a.point.p_OC.x() * b.point.p_OC.x() > 0.0);
}

TEST(FindContacts, ASoftBallOnAPlaneHasTheTorsionOfItsRadius) {
  Material rubber;
  rubber.friction = 1.0;
  rubber.youngs_modulus = 1.5e6;
  for (const double r : {0.007, 0.010, 0.014}) {
    const auto contacts = contacts_on_cube(testing::ball_mesh(r, 64), at(0, 0, 0.03 + r + gap), rubber);
    ASSERT_FALSE(contacts.empty());  // the touching region of the largest is wider than the merge distance
    const double expected = soft_finger_torsion_length(1.0 / r, 1.0 / r, 1.5e6);
    EXPECT_GT(expected, 0.0);
    EXPECT_NEAR(contacts[0].point.torsion_length, expected, 0.05 * expected) << r;
    EXPECT_EQ(contacts[0].point.mu, 1.0);
  }
}

TEST(FindContacts, LinksComeInTheirOrderWithTheirFriction) {
  auto hand = testing::parallel_gripper();
  auto rubber_hand = std::make_shared<HandModel>(*hand);
  rubber_hand->links[1].material.name = "rubber";
  rubber_hand->links[2].material.name = "metal";
  Scene scene = scene_of(rubber_hand, solid(box_mesh({0.04, 0.04, 0.04})));
  scene.object_material.name = "glass";
  const CollisionModel model = exact_model(scene);
  const double reach = 0.02 + gap;
  const auto contacts = find_contacts(model, {at(0, 0, -0.1), at(-reach, 0, -0.03), at(reach, 0, -0.03)});
  ASSERT_EQ(contacts.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(contacts[i].link, i < 4 ? "left" : "right");
    EXPECT_EQ(contacts[i].point.mu, table_friction(i < 4 ? "rubber" : "metal", "glass"));
    EXPECT_EQ(contacts[i].patch, i < 4 ? 0 : 1);
  }
}

// Whatever touches, corner, edge or face, presses into the object, within the cone of its faces.
TEST(FindContacts, NormalsOfAnyTouchPointIntoTheObject) {
  RandomStream random{1};
  const CollisionModel model =
      exact_model(scene_of(pad(box_mesh({0.015, 0.02, 0.05})), solid(box_mesh({0.06, 0.06, 0.06}))));
  const MeshBvh& object = model.scene().object->bvh;
  const MeshBvh& link = model.surfaces().links[0].bvh;
  int contacts = 0;
  for (int i = 0; i < 300; ++i) {
    Pose X = testing::any_pose(random, 0.03);
    X.translation() += 0.12 * testing::random_direction(random);
    const ClosestPair pair = closest_pair(object, link, X);
    X.translation() += (1.0 - gap / pair.distance) * (pair.p_a - pair.p_b);
    const auto found = find_contacts(model, {X});
    EXPECT_FALSE(found.empty()) << i;
    for (const GraspContact& c : found) {
      EXPECT_LT(object.signed_distance(c.point.p_OC + 1e-4 * c.point.n_OC), 1e-5)
          << i << ": " << c.point.n_OC.transpose();
      EXPECT_LT(link.closest_point(X.inverse() * c.point.p_OC).distance, 0.0002 + 1e-9);
      ++contacts;
    }
  }
  EXPECT_GE(contacts, 300);
}

}  // namespace
}  // namespace eigengrasp
