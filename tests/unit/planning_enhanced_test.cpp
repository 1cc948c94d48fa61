// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The enhanced search (section V-B) on shipped hands and objects.
#include <gtest/gtest.h>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"
#include "eigengrasp/planning/search_areas.hpp"
#include "support/shipped_scenes.hpp"

namespace eigengrasp {
namespace {

using testing::shipped_scene;

PlanOptions enhanced(int grasps, int threads) {
  PlanOptions options;
  options.search = SearchKind::enhanced;
  options.iterations = 60000;
  options.grasps = grasps;
  options.threads = threads;
  return options;
}

/// As the planner's header says it: root of the summed squares of differences over 15 mm, 0.35 rad, 0.5 rad.
double apart(const HandModel& hand, const Grasp& a, const Grasp& b) {
  const Vec3 shift = a.X_OH_pregrasp * hand.approach_point_H - b.X_OH_pregrasp * hand.approach_point_H;
  const double turn = angle_between(a.X_OH_pregrasp.linear(), b.X_OH_pregrasp.linear());
  const double shape = (a.pregrasp_dofs - b.pregrasp_dofs).norm();
  return std::hypot(shift.norm() / 0.015, turn / 0.35, shape / 0.5);
}

TEST(EnhancedSearch, EndsWithTheGraspsThatAreWantedFormClosedAndDistinct) {
  const Scene scene = shipped_scene("barrett-rubber", "flask");
  const PlanResult result = plan_grasps(scene, enhanced(12, 0));
  ASSERT_EQ(result.grasps.size(), 12U) << result.explanation;
  EXPECT_EQ(result.status, PlanStatus::found);
  EXPECT_FALSE(result.stopped_early);
  EXPECT_LT(result.states.evaluated, 60000) << "ends once it has what is wanted";
  EXPECT_EQ(result.grasps[0].provenance.planner, "enhanced/contact");
  for (std::size_t i = 0; i < result.grasps.size(); ++i) {
    EXPECT_TRUE(result.grasps[i].form_closure);
    EXPECT_GT(result.grasps[i].volume, 0.0);
    EXPECT_LE(result.grasps[i].epsilon, result.grasps[i == 0 ? 0 : i - 1].epsilon);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GE(apart(*scene.hand, result.grasps[i], result.grasps[k]), 1.0) << i << " and " << k;
  }
}

TEST(EnhancedSearch, PreGraspsLieInTheEigengraspPlane) {
  const Scene scene = shipped_scene("human", "glass");
  const PlanResult result = plan_grasps(scene, enhanced(5, 0));
  ASSERT_FALSE(result.grasps.empty()) << result.explanation;
  const SearchSpace space(scene, 2);
  for (const Grasp& g : result.grasps) {
    ASSERT_EQ(g.amplitudes.size(), 2);
    const VecX posture = clamp_posture(*scene.hand, space.postures.embed(g.amplitudes));
    EXPECT_LT((posture - g.pregrasp_dofs).norm(), 1e-9);
    EXPECT_GT((g.grasp_dofs - g.pregrasp_dofs).norm(), 1e-3) << "the fingers close";
  }
}

TEST(EnhancedSearch, FindsTheSameOnOneAndOnTwoThreads) {
  // Metal on a flat object: few pre-grasps close as they stand, so that children anneal as well.
  const Scene scene = shipped_scene("barrett-metal", "phone");
  const PlanResult one = plan_grasps(scene, enhanced(6, 1));
  const PlanResult two = plan_grasps(scene, enhanced(6, 2));
  EXPECT_EQ(one.states.evaluated, two.states.evaluated);
  EXPECT_EQ(one.closed_on_the_way, two.closed_on_the_way);
  EXPECT_EQ(one.explanation, two.explanation);
  ASSERT_EQ(one.grasps.size(), two.grasps.size());
  ASSERT_FALSE(one.grasps.empty()) << one.explanation;
  for (std::size_t i = 0; i < one.grasps.size(); ++i) {
    EXPECT_EQ(one.grasps[i].X_OH_pregrasp.matrix(), two.grasps[i].X_OH_pregrasp.matrix());
    EXPECT_EQ(one.grasps[i].grasp_dofs, two.grasps[i].grasp_dofs);
    EXPECT_EQ(one.grasps[i].epsilon, two.grasps[i].epsilon);
  }
}

TEST(EnhancedSearch, EndsAtItsBudgetAndAtTheStopFlag) {
  const Scene scene = shipped_scene("barrett-metal", "plane", 3.0);
  PlanOptions options = enhanced(100000, 1);
  options.iterations = 20000;
  const PlanResult spent = plan_grasps(scene, options);
  EXPECT_GE(spent.states.evaluated, 20000);
  EXPECT_LT(spent.states.evaluated, 40000);
  EXPECT_FALSE(spent.stopped_early);
  StopFlag stop;
  stop.request_stop();
  options.stop = &stop;
  options.iterations = 1000000000000;
  EXPECT_TRUE(plan_grasps(scene, options).stopped_early);
}

TEST(SearchAreas, HoldStatesAsTheyHoldPreGrasps) {
  const Scene scene = shipped_scene("human", "glass");
  const SearchSpace space(scene, 2);
  Distinctness size;
  size.approach_point_H = scene.hand->approach_point_H;
  SearchAreas areas(*scene.hand, space, size);
  HandState center;
  center.amplitudes = VecX::Zero(2);
  EXPECT_FALSE(areas.holds(center));
  PreGrasp p;
  p.X_OH = hand_pose(*scene.hand, center);
  p.dofs = hand_posture(*scene.hand, space, center);
  areas.add(p);
  EXPECT_TRUE(areas.holds(center));
  EXPECT_TRUE(areas.holds(p));
  HandState near = center;
  near.p_OA.x() += 0.014;
  EXPECT_TRUE(areas.holds(near));
  near.p_OA.x() += 0.002;
  EXPECT_FALSE(areas.holds(near));
  HandState turned = center;
  turned.q_OA = Eigen::Quaterniond(Eigen::AngleAxisd(0.34, Vec3::UnitY()));
  EXPECT_TRUE(areas.holds(turned));
  turned.q_OA = Eigen::Quaterniond(Eigen::AngleAxisd(0.36, Vec3::UnitY()));
  EXPECT_FALSE(areas.holds(turned));
}

TEST(SearchAreas, ChainsKeepAwayFromThem) {
  const Scene scene = shipped_scene("barrett-rubber", "glass");
  const CollisionModel model(scene, {});
  const PlanOptions options;
  const GraspEnergy energy(model, options);
  const SearchSpace space(scene, 2);
  const StateEvaluator evaluator(model, space.postures, options.alpha);
  Distinctness size;
  size.approach_point_H = scene.hand->approach_point_H;
  const auto best_of = [&](const SearchAreas* avoided) {
    Annealer::Task task{model, energy, space, evaluator, AnnealingSchedule{}, 7};
    task.avoided = avoided;
    Annealer annealer(task, 0, 16, PreGraspList(20, size));
    for (int i = 0; i < 250; ++i) annealer.step(i / 250.0, 16);
    return annealer.best().items();
  };
  const auto before = best_of(nullptr);
  ASSERT_FALSE(before.empty());
  SearchAreas areas(*scene.hand, space, size);
  for (const PreGrasp& p : before) areas.add(p);
  const auto after = best_of(&areas);
  ASSERT_FALSE(after.empty());
  for (const PreGrasp& p : after) EXPECT_FALSE(areas.holds(p));
}

}  // namespace
}  // namespace eigengrasp
