// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The first stage against eq. (8) worked out in full and against the cone; the shown hand against exact
// meshes.
#include <gtest/gtest.h>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/online/simulated_operator.hpp"
#include "online/approach_search.hpp"
#include "online/shown_hand.hpp"
#include "support/shipped_scenes.hpp"

namespace eigengrasp {
namespace {

using Variable = VariableTarget::Variable;

PlanOptions wrench_options() {
  PlanOptions options;
  options.energy = EnergyKind::wrench;
  return options;
}

/// Barrett's hand and the flask, prepared once.
struct Prepared {
  Scene scene = testing::shipped_scene("barrett-rubber", "flask");
  CollisionModel model{scene, {}};
  GraspEnergy energy{model, wrench_options()};
  OnlineOptions options;
  StateEvaluator evaluator{
      model, scene.hand->eigengrasps.with_size(2, scene.hand->dof_min(), scene.hand->dof_max()), 0.05};
  Pose wrist = SimulatedOperator(scene, {}, 3).wrist();

  std::vector<PreGrasp> search(int steps, const std::vector<VariableTarget>& targets = {}) const {
    ApproachSearch search({model, energy, evaluator, options});
    search.aim(targets);
    search.begin(wrist);
    std::vector<PreGrasp> found;
    for (int i = 0; i < steps; ++i) search.step(found);
    return found;
  }
};

const Prepared& prepared() {
  static const Prepared instance;
  return instance;
}

TEST(ApproachSearch, SameSeedSameCandidates) {
  const auto a = prepared().search(600);
  const auto b = prepared().search(600);
  ASSERT_FALSE(a.empty());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].X_OH.matrix(), b[i].X_OH.matrix());
    EXPECT_EQ(a[i].energy, b[i].energy);
  }
}

TEST(ApproachSearch, CandidatesAreNearlyFreeLieInTheConeAndHaveTheEnergyOfEquation8) {
  const Prepared& p = prepared();
  const auto found = p.search(1500);
  ASSERT_GT(found.size(), 20u);
  int with_closure = 0;
  std::vector<Pose> X_OL;
  std::vector<ContactApproach> approaches;
  for (const PreGrasp& c : found) {
    const ApproachOffset o = offset_from(*p.scene.hand, p.wrist, c.X_OH);
    EXPECT_LE(o.angle, p.options.cone_half_angle + 1e-6);
    EXPECT_LE(std::hypot(o.distance, o.offset), p.options.look_ahead + 1e-6);
    EXPECT_GE(o.distance, -p.options.step_back - 1e-6);
    compute_link_poses(*p.scene.hand, joint_values(*p.scene.hand, c.dofs), c.X_OH, X_OL);
    EXPECT_LT(p.model.deepest_penetration(X_OL), 0.001);
    p.energy.approach(X_OL, DistanceSource::gradients, approaches);
    EXPECT_NEAR(c.energy, p.energy.wrench_energy(approaches), 1e-6);
    with_closure += c.energy < 0.0;
  }
  EXPECT_GT(with_closure, 0);
}

TEST(ApproachSearch, KeepsToWhatTheOperatorIsSureOf) {
  const double spread = 0.5;
  for (const PreGrasp& c : prepared().search(400, {{Variable::dof, 0, spread, 1.0}}))
    EXPECT_NEAR(c.dofs[0], spread, 1e-12);
  const auto narrow = prepared().search(400, {{Variable::theta, 0, 0.0, 1.0}});
  ASSERT_FALSE(narrow.empty());
  for (const PreGrasp& c : narrow)
    EXPECT_NEAR(offset_from(*prepared().scene.hand, prepared().wrist, c.X_OH).angle, 0.0, 1e-6);
}

TEST(ApproachSearch, GoesOnWithAWristThatMoves) {
  const Prepared& p = prepared();
  ApproachSearch search({p.model, p.energy, p.evaluator, p.options});
  search.begin(p.wrist);
  std::vector<PreGrasp> found;
  Pose wrist = p.wrist;
  for (int i = 0; i < 800; ++i) {
    if (i % 10 == 9) {
      wrist = wrist * Eigen::Translation3d(0.0005 * p.scene.hand->approach_direction_H);
      search.follow(wrist);
    }
    search.step(found);
  }
  ASSERT_FALSE(found.empty());
  const ApproachOffset o = offset_from(*p.scene.hand, wrist, found.back().X_OH);
  EXPECT_LE(o.angle, p.options.cone_half_angle + 1e-6);
  EXPECT_EQ(search.iterations(), 800 * ApproachSearch::n_chains);
}

TEST(WrenchEnergy, ASearchThatStopsEarlyErrsOnlyWhereItMay) {
  const Prepared& p = prepared();
  std::vector<Pose> X_OL;
  std::vector<ContactApproach> approaches;
  WeakDirections weak;
  int negative = 0;
  for (const PreGrasp& c : p.search(1500)) {
    compute_link_poses(*p.scene.hand, joint_values(*p.scene.hand, c.dofs), c.X_OH, X_OL);
    p.energy.approach(X_OL, DistanceSource::gradients, approaches);
    const double full = p.energy.wrench_energy(approaches);
    negative += full < 0.0;
    for (const double threshold : {full - 1.0, full + 1.0, 1e8}) {
      const double all = p.energy.wrench_energy(approaches, threshold, weak, 0);
      const double few = p.energy.wrench_energy(approaches, threshold, weak, 2);
      if (full < threshold) {
        EXPECT_NEAR(all, full, 1e-9);
        EXPECT_LE(few, full + 1e-9) << "too low at most";
      } else {
        EXPECT_GE(all, threshold);
      }
    }
  }
  EXPECT_GT(negative, 5);
}

TEST(ShownHand, IsFreeAtEveryMomentOfAWayThroughTheObject) {
  const Prepared& p = prepared();
  ShownHand hand(p.model, p.options);
  const Pose start = p.wrist;
  bool was_blocked = false;
  for (int i = 0; i <= 120; ++i) {
    const Pose wrist = start * Eigen::Translation3d(0.003 * i * p.scene.hand->approach_direction_H);
    hand.follow(wrist, nullptr, 0.02);
    std::vector<Pose> X_OL;
    compute_link_poses(*p.scene.hand, hand.joints(), hand.X_OH(), X_OL);
    ASSERT_EQ(p.model.check_exact(X_OL), Legality::legal) << i;
    for (std::size_t l = 0; l < X_OL.size(); ++l) EXPECT_TRUE(X_OL[l].isApprox(hand.X_OL()[l], 1e-12));
    EXPECT_TRUE(hand.blocked() || hand.X_OH().isApprox(wrist, 1e-12));
    was_blocked = was_blocked || hand.blocked();
  }
  EXPECT_TRUE(was_blocked);
}

TEST(ShownHand, TakesThePostureOfTheOfferedGraspAsItComesNear) {
  const Prepared& p = prepared();
  Grasp offer;
  offer.X_OH_pregrasp = p.wrist;
  offer.pregrasp_dofs = p.scene.hand->rest_posture();
  offer.pregrasp_dofs[0] += 0.8;
  ShownHand hand(p.model, p.options);
  double last = 0.0;
  for (int i = 60; i >= 0; --i) {
    const Pose wrist = p.wrist * Eigen::Translation3d(-0.0025 * i * p.scene.hand->approach_direction_H);
    hand.follow(wrist, &offer, 0.05);
    EXPECT_TRUE(i < 60 || hand.preshape() == 0.0);
    EXPECT_GE(hand.dofs()[0], last - 1e-12);
    last = hand.dofs()[0];
  }
  EXPECT_EQ(hand.preshape(), 1.0);
  EXPECT_NEAR(hand.dofs()[0], offer.pregrasp_dofs[0], 1e-9);
}

TEST(ShownHand, ReachesEveryOfferedPreGraspThoughItsFingersStandInTheWay) {
  const Prepared& p = prepared();
  const Vec3 ahead = p.scene.hand->approach_direction_H;
  int offers = 0;
  int held_up = 0;
  for (const PreGrasp& c : p.search(1500)) {
    std::vector<Pose> X_OL;
    compute_link_poses(*p.scene.hand, joint_values(*p.scene.hand, c.dofs), c.X_OH, X_OL);
    if (p.model.check_exact(X_OL) != Legality::legal) continue;
    Grasp offer;
    offer.X_OH_pregrasp = c.X_OH;
    offer.pregrasp_dofs = c.dofs;
    ShownHand hand(p.model, p.options);
    bool blocked = false;
    for (int i = 80; i >= -60; --i) {
      hand.follow(c.X_OH * Eigen::Translation3d(-0.002 * std::max(i, 0) * ahead), &offer, 0.02);
      blocked = blocked || hand.blocked();
    }
    ++offers;
    held_up += blocked;
    EXPECT_FALSE(hand.blocked()) << offers;
    EXPECT_TRUE(hand.X_OH().isApprox(c.X_OH, 1e-12)) << offers;
    EXPECT_TRUE(hand.dofs().isApprox(c.dofs, 1e-12)) << offers;
  }
  EXPECT_GT(offers, 20);
  EXPECT_GT(held_up, 0);
}

}  // namespace
}  // namespace eigengrasp
