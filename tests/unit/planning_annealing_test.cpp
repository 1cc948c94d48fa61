// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The parts of the search: schedule, neighbourhood, list of the best, energies, options.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "eigengrasp/planning/annealer.hpp"
#include "support/parallel_gripper.hpp"

namespace eigengrasp {
namespace {

using testing::at;
using testing::box_mesh;
using testing::scene_of;
using testing::solid;

TEST(AnnealingSchedule, HasTheNumbersOfVeryFastAnnealing) {
  const AnnealingSchedule schedule;
  EXPECT_NEAR(schedule.temperature(0.0), 9.36e-6, 0.005e-6);
  EXPECT_NEAR(schedule.acceptance_temperature(0.0), 9.36, 0.1);
  EXPECT_NEAR(schedule.acceptance_temperature(1.0), 0.55, 0.01);
  double last = schedule.temperature(0.0);
  for (double progress = 0.05; progress <= 1.0; progress += 0.05) {
    const double k = 30000.0 + progress * 40000.0;
    EXPECT_NEAR(schedule.temperature(progress), 1e6 * std::exp(-7.0 * std::pow(k, 0.125)), 1e-12);
    EXPECT_LT(schedule.temperature(progress), last);
    last = schedule.temperature(progress);
  }
}

TEST(NeighborJump, StaysWithinOneAndIsSymmetric) {
  for (const double temperature : {1e-9, 9.36e-6, 0.01, 1.0}) {
    for (int i = 0; i <= 1000; ++i) {
      const double u = i / 1001.0;
      const double y = NeighborJump(temperature)(u);
      EXPECT_GE(y, -1.0 - 1e-12);
      EXPECT_LE(y, 1.0 + 1e-12);
      if (i > 0) {
        EXPECT_NEAR(NeighborJump(temperature)(1.0 - u), -y, 1e-9);
      }
    }
    EXPECT_EQ(NeighborJump(temperature)(0.5), 0.0);
    EXPECT_NEAR(NeighborJump(temperature)(0.0), -1.0, 1e-9);
  }
}

TEST(NeighborJump, HasANarrowMiddleAndWideTails) {
  RandomStream random{1};
  const double temperature = AnnealingSchedule().temperature(0.0);
  std::vector<double> size(200000);
  for (double& y : size) y = std::abs(NeighborJump(temperature)(random.uniform()));
  std::sort(size.begin(), size.end());
  EXPECT_NEAR(size[size.size() / 2], 0.003, 0.0003);
  const auto wide = size.end() - std::upper_bound(size.begin(), size.end(), 0.1);
  EXPECT_NEAR(static_cast<double>(wide) / static_cast<double>(size.size()), 0.20, 0.01);
}

PreGrasp random_pregrasp(RandomStream& random) {
  PreGrasp p;
  p.X_OH = make_pose(Eigen::Quaterniond(1.0, 0.3 * random.normal(), 0.0, 0.0),
                     0.03 * Vec3(random.uniform(), random.uniform(), 0.0));
  p.dofs = VecX::Constant(3, 0.3 * random.uniform());
  p.energy = random.uniform(0.0, 50.0);
  return p;
}

TEST(PreGraspList, KeepsTheBestDistinctOnesInOrder) {
  Distinctness distinct;
  distinct.approach_point_H = Vec3(0.0, 0.0, 0.05);
  for (const std::size_t capacity : {1u, 5u, 20u}) {
    RandomStream random{capacity};
    PreGraspList list(capacity, distinct);
    std::vector<PreGrasp> expected;
    double lowest = 1e9;
    for (int i = 0; i < 2000; ++i) {
      const PreGrasp candidate = random_pregrasp(random);
      lowest = std::min(lowest, candidate.energy);
      // By hand: refused by a better one that is the same; else worse ones that are the same go.
      const bool fits = expected.size() < capacity || candidate.energy < expected.back().energy;
      const bool admitted = fits && std::none_of(expected.begin(), expected.end(), [&](const PreGrasp& e) {
                              return e.energy <= candidate.energy && distinct.between(e, candidate) < 1.0;
                            });
      if (admitted) {
        std::erase_if(expected, [&](const PreGrasp& e) { return distinct.between(e, candidate) < 1.0; });
        expected.push_back(candidate);
        std::stable_sort(expected.begin(), expected.end(),
                         [](const PreGrasp& a, const PreGrasp& b) { return a.energy < b.energy; });
        if (expected.size() > capacity) expected.pop_back();
      }
      EXPECT_EQ(list.admits(candidate.energy), fits);
      EXPECT_EQ(list.add(candidate), admitted);
      ASSERT_EQ(list.items().size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(list.items()[k].energy, expected[k].energy);
    }
    EXPECT_EQ(list.items().front().energy, lowest);
    for (std::size_t a = 0; a < list.items().size(); ++a)
      for (std::size_t b = 0; b < a; ++b) EXPECT_GE(distinct.between(list.items()[a], list.items()[b]), 1.0);
  }
}

TEST(Distinctness, CountsPositionRotationAndPosture) {
  const Distinctness distinct;
  PreGrasp a;
  a.dofs = VecX::Zero(2);
  PreGrasp b = a;
  EXPECT_EQ(distinct.between(a, b), 0.0);
  b.X_OH.translation().x() = 0.009;
  EXPECT_NEAR(distinct.between(a, b), 0.6, 1e-9);
  b.dofs[1] = 0.4;
  EXPECT_NEAR(distinct.between(a, b), 1.0, 1e-9);
  PreGrasp c = a;
  c.X_OH.linear() = Eigen::AngleAxisd(0.35, Vec3::UnitY()).toRotationMatrix();
  EXPECT_NEAR(distinct.between(a, c), 1.0, 1e-9);
}

TEST(PlanOptions, EachViolationIsASentence) {
  const auto hand = testing::parallel_gripper();
  EXPECT_TRUE((PlanOptions{.amplitudes = 1, .progress = {}}.validate(*hand).empty()));
  const auto complains = [&](const PlanOptions& options, const std::string& part) {
    const auto violations = options.validate(*hand);
    return violations.size() == 1 && violations[0].find(part) != std::string::npos;
  };
  EXPECT_TRUE(
      complains({.iterations = -5, .time_limit = 1.0, .amplitudes = 1, .progress = {}}, "iterations is -5"));
  EXPECT_TRUE(
      complains({.iterations = 0, .amplitudes = 1, .progress = {}}, "neither iterations nor a time limit"));
  EXPECT_TRUE(complains({.time_limit = -1.0, .amplitudes = 1, .progress = {}}, "time limit is -1"));
  EXPECT_TRUE(complains({.grasps = 0, .amplitudes = 1, .progress = {}}, "grasps is 0"));
  EXPECT_TRUE(complains({.threads = -1, .amplitudes = 1, .progress = {}}, "threads is -1"));
  EXPECT_TRUE(complains({.chains = 0, .amplitudes = 1, .progress = {}}, "chains is 0"));
  EXPECT_TRUE(complains({.amplitudes = 2, .progress = {}}, "eigengrasps is 2, expected 0 to 1"));
  EXPECT_TRUE(complains({.amplitudes = 1, .alpha = 0.0, .progress = {}}, "alpha is 0"));
  EXPECT_TRUE(complains({.amplitudes = 1, .cone_edges = 2, .progress = {}}, "cone edges is 2"));
  EXPECT_TRUE(complains({.amplitudes = 1, .torque_scale = -1.0, .progress = {}}, "torque scale is -1"));
  EXPECT_FALSE(
      (PlanOptions{.time_limit = std::nan(""), .amplitudes = 1, .progress = {}}.validate(*hand).empty()));
  auto bare = testing::parallel_gripper();
  bare->virtual_contacts.clear();
  EXPECT_EQ((PlanOptions{.amplitudes = 1, .progress = {}}.validate(*bare).size()), 1u);
}

TEST(GraspEnergy, OfFingersThatFaceABoxIsTheDistanceInMillimetres) {
  const Scene scene =
      scene_of(testing::parallel_gripper(), solid(box_mesh({0.04, 0.04, 0.04}), {0.0, 0.0, 0.03}));
  const CollisionModel model = testing::exact_model(scene);
  const GraspEnergy energy(model, {});
  std::vector<ContactApproach> approaches;
  energy.approach({Pose::Identity(), at(-0.03, 0.0, 0.0), at(0.026, 0.0, 0.0)}, DistanceSource::exact,
                  approaches);
  ASSERT_EQ(approaches.size(), 2u);
  EXPECT_NEAR(approaches[0].distance, 0.010, 1e-12);
  EXPECT_NEAR(approaches[0].cosine, 1.0, 1e-12);
  EXPECT_NEAR(approaches[1].distance, 0.006, 1e-12);
  EXPECT_NEAR(energy.contact_energy(approaches), 0.5 * (10.0 + 6.0), 1e-9);
  EXPECT_NEAR(energy.paper_quality(approaches), 2.0 - 0.010 / 0.050 - 0.006 / 0.050, 1e-9);
}

TEST(GraspEnergy, CountsTheAngleOfTheVirtualContact) {
  auto hand = testing::pad(box_mesh({0.01, 0.01, 0.01}));
  hand->virtual_contacts.push_back({0, Vec3(0.0, 0.0, -0.005), Vec3(std::sqrt(0.75), 0.0, -0.5)});
  const CollisionModel model(scene_of(hand, solid(box_mesh({0.06, 0.06, 0.06}))), {});
  const GraspEnergy energy(model, {});
  std::vector<ContactApproach> exact, field;
  energy.approach({at(0.0, 0.0, 0.045)}, DistanceSource::exact, exact);
  energy.approach({at(0.0, 0.0, 0.045)}, DistanceSource::field, field);
  EXPECT_NEAR(energy.contact_energy(exact), 10.0 + 50.0 * 0.5, 1e-9);
  EXPECT_NEAR(energy.contact_energy(field), 10.0 + 50.0 * 0.5, 1e-3);
  EXPECT_NEAR(energy.evaluate({at(0.0, 0.0, 0.045)}, DistanceSource::exact, exact), 35.0, 1e-9);
}

TEST(GraspEnergy, WrenchEnergyIsEpsilonOfTheScaledWrenches) {
  auto hand = testing::pad(box_mesh({0.01, 0.01, 0.01}));
  for (int i = 0; i < 6; ++i) hand->virtual_contacts.push_back({});
  const CollisionModel model = testing::exact_model(scene_of(hand, solid(testing::ball_mesh(0.03, 16))));
  const GraspEnergy energy(model, {.energy = EnergyKind::wrench, .progress = {}});
  std::vector<ContactApproach> approaches;
  std::vector<ContactPoint> points;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 n = -side * Vec3::Unit(axis);
      approaches.push_back({0.0, 1.0, -0.03 * n + 0.01 * Vec3::Unit((axis + 1) % 3), n});
      points.push_back({approaches.back().p_OC, n, table_friction("", ""), 0.0});
    }
  const double epsilon = compute_epsilon(points, energy.wrench_space()).epsilon;
  ASSERT_GT(epsilon, 0.01);
  EXPECT_NEAR(energy.wrench_energy(approaches), -100.0 * epsilon, 1e-9);
  EXPECT_EQ(energy.wrench_space().torque_scale, model.scene().object->max_radius);
  // delta is 1/2: all wrenches, and so epsilon, are half as long.
  for (ContactApproach& a : approaches) a.distance = 0.025;
  EXPECT_NEAR(energy.wrench_energy(approaches), -50.0 * epsilon, 1e-9);
  // delta is 1 or more: no wrench is left, and the contact energy leads the way.
  for (ContactApproach& a : approaches) a.distance = 0.060;
  EXPECT_NEAR(energy.wrench_energy(approaches), 60.0, 1e-9);
}

}  // namespace
}  // namespace eigengrasp
