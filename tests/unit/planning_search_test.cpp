// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Whole plans of simple grippers: repeatable, bounded, checked, and able to say why nothing was found.
#include <gtest/gtest.h>

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"
#include "planning/pregrasp_search.hpp"
#include "support/parallel_gripper.hpp"

namespace eigengrasp {
namespace {

using testing::box_mesh;
using testing::scene_of;
using testing::solid;

Scene block_scene() {
  auto hand = testing::two_finger_hand();
  for (HandLink& link : hand->links) link.material = {"rubber", 1.0, 1.5e6};
  set_collision_pairs(*hand, {});
  return scene_of(hand, solid(box_mesh({0.03, 0.035, 0.04})));
}

const PlanOptions quick{
    .iterations = 6000, .grasps = 8, .seed = 3, .threads = 1, .chains = 2, .progress = {}};

void expect_same_contacts(const Grasp& a, const Grasp& b) {
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    EXPECT_EQ(a.contacts[i].link, b.contacts[i].link);
    EXPECT_EQ(a.contacts[i].patch, b.contacts[i].patch);
    EXPECT_EQ(a.contacts[i].point.p_OC, b.contacts[i].point.p_OC);
    EXPECT_EQ(a.contacts[i].point.n_OC, b.contacts[i].point.n_OC);
    EXPECT_EQ(a.contacts[i].point.mu, b.contacts[i].point.mu);
    EXPECT_EQ(a.contacts[i].point.torsion_length, b.contacts[i].point.torsion_length);
  }
}

void expect_same(const Grasp& a, const Grasp& b) {
  EXPECT_EQ(a.X_OH.matrix(), b.X_OH.matrix());
  EXPECT_EQ(a.X_OH_pregrasp.matrix(), b.X_OH_pregrasp.matrix());
  EXPECT_EQ(a.pregrasp_dofs, b.pregrasp_dofs);
  EXPECT_EQ(a.grasp_dofs, b.grasp_dofs);
  EXPECT_EQ(a.pregrasp_joints, b.pregrasp_joints);
  EXPECT_EQ(a.grasp_joints, b.grasp_joints);
  EXPECT_EQ(a.amplitudes, b.amplitudes);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.epsilon, b.epsilon);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.form_closure, b.form_closure);
  EXPECT_EQ(a.max_penetration, b.max_penetration);
  EXPECT_EQ(a.provenance.options_digest, b.provenance.options_digest);
  expect_same_contacts(a, b);
}

void expect_same(const PlanResult& a, const PlanResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.explanation, b.explanation);
  EXPECT_EQ(a.states.evaluated, b.states.evaluated);
  EXPECT_EQ(a.states.legal, b.states.legal);
  EXPECT_EQ(a.states.hit_object, b.states.hit_object);
  EXPECT_EQ(a.states.hit_itself, b.states.hit_itself);
  ASSERT_EQ(a.milestones.size(), b.milestones.size());
  for (std::size_t i = 0; i < a.milestones.size(); ++i) {
    EXPECT_EQ(a.milestones[i].iteration, b.milestones[i].iteration);
    EXPECT_EQ(a.milestones[i].energy, b.milestones[i].energy);
    EXPECT_EQ(a.milestones[i].X_OH.matrix(), b.milestones[i].X_OH.matrix());
  }
  ASSERT_EQ(a.grasps.size(), b.grasps.size());
  for (std::size_t i = 0; i < a.grasps.size(); ++i) expect_same(a.grasps[i], b.grasps[i]);
}

TEST(PlanGrasps, TheNumberOfThreadsChangesNothingAndTheSeedDoes) {
  const Scene scene = block_scene();
  PlanOptions options = quick;
  const PlanResult one = plan_grasps(scene, options);
  options.threads = 2;
  const PlanResult two = plan_grasps(scene, options);
  ASSERT_FALSE(one.grasps.empty()) << one.explanation;
  EXPECT_EQ(one.states.evaluated, 6000);
  expect_same(one, two);
  options.seed = 4;
  const PlanResult other = plan_grasps(scene, options);
  ASSERT_FALSE(other.grasps.empty());
  EXPECT_NE(other.grasps[0].X_OH.matrix(), one.grasps[0].X_OH.matrix());
}

TEST(PlanGrasps, MilestonesComeAsTheyAreFoundAndWatchingChangesNothing) {
  const Scene scene = block_scene();
  const PlanResult plain = plan_grasps(scene, quick);
  for (const int threads : {1, 2}) {
    PlanOptions options = quick;
    options.threads = threads;
    std::vector<SearchMilestone> heard;
    options.milestone = [&](const SearchMilestone& m) { heard.push_back(m); };
    const PlanResult watched = plan_grasps(scene, options);
    expect_same(plain, watched);
    ASSERT_FALSE(heard.empty());
    for (std::size_t i = 1; i < heard.size(); ++i) EXPECT_LT(heard[i].energy, heard[i - 1].energy);
    EXPECT_LE(heard.back().iteration, watched.states.evaluated);
    EXPECT_EQ(heard.back().energy, watched.milestones.back().energy);  // the best of all chains
    EXPECT_EQ(heard.back().X_OH.matrix(), watched.milestones.back().X_OH.matrix());
  }
}

TEST(PlanGrasps, ASceneThatWasPreparedBeforeGivesTheSameGrasps) {
  const Scene scene = block_scene();
  CollisionModel::Options prepared;
  prepared.threads = 1;
  const CollisionModel model(scene, prepared);
  expect_same(plan_grasps(scene, quick), plan_grasps(model, quick));
}

TEST(PlanGrasps, EveryGraspWithstandsTheExactCheck) {
  const Scene scene = block_scene();
  const HandModel& hand = *scene.hand;
  const CollisionModel exact = testing::exact_model(scene);
  const PlanResult result = plan_grasps(scene, quick);
  ASSERT_EQ(result.status, PlanStatus::found) << result.explanation;
  EXPECT_LE(result.grasps.size(), 8u);
  for (std::size_t k = 0; k < result.grasps.size(); ++k) {
    const Grasp& g = result.grasps[k];
    VecX joints = VecX::Zero(hand.n_joints());
    for (const auto& [name, value] : g.grasp_joints) joints[hand.find_joint(name)] = value;
    std::vector<Pose> X_OL;
    compute_link_poses(hand, joints, g.X_OH, X_OL);
    EXPECT_LE(g.max_penetration, 0.0005);
    EXPECT_EQ(exact.deepest_penetration(X_OL), g.max_penetration);
    for (const GraspContact& c : g.contacts) {
      const auto link = static_cast<std::size_t>(hand.find_link(c.link));
      const MeshBvh surface(hand.links[link].mesh);
      EXPECT_LT(surface.closest_point(X_OL[link].inverse() * c.point.p_OC).distance, 0.0002 + 1e-9);
      EXPECT_LT(scene.object->bvh.closest_point(c.point.p_OC).distance, 1e-7);
      EXPECT_LT(scene.object->bvh.signed_distance(c.point.p_OC + 1e-4 * c.point.n_OC), 1e-6)
          << "the normal does not point into the object: " << c.link << " " << c.point.n_OC.transpose();
    }
    for (Eigen::Index d = 0; d < g.grasp_dofs.size(); ++d) {
      EXPECT_GE(g.pregrasp_dofs[d], hand.dof_min()[d]);
      EXPECT_LE(g.grasp_dofs[d], hand.dof_max()[d] + 1e-9);
    }
    EXPECT_EQ(g.form_closure, g.epsilon >= 1e-6);
    if (k == 0) continue;
    const Grasp& last = result.grasps[k - 1];
    EXPECT_GE(last.form_closure, g.form_closure);
    EXPECT_TRUE(!g.form_closure || last.epsilon >= g.epsilon) << "by falling epsilon";
  }
}

TEST(TestPregrasp, ThePalmMovesBeforeOrAfterTheFirstClosingOrNotAtAll) {
  const CollisionModel model(block_scene(), CollisionModel::Options{});
  const GraspEnergy energy(model, quick);
  const auto at = [](double z) {
    PreGrasp p;
    p.X_OH = Pose::Identity();
    p.X_OH.translation() = Vec3(0.0, 0.0, z);
    p.dofs = VecX::Zero(2);
    return p;
  };
  const PreGrasp near = at(-0.045);  // the palm is 10 mm away
  const PreGrasp far = at(-0.085);   // the fingertips hold the block's edge
  const TestedPreGrasp stays = test_pregrasp(model, energy, near, {});
  EXPECT_EQ(stays.result.tests, 1);
  EXPECT_FALSE(stays.palm_moved);
  const TestedPreGrasp moves = test_pregrasp(model, energy, near, {0.03, true});
  EXPECT_TRUE(moves.palm_moved);
  EXPECT_NEAR(moves.pregrasp.X_OH.translation().z(), -0.035, 5e-4);
  // It moves first where that is wanted, else only where the fingers do not close as it stands.
  EXPECT_EQ(test_pregrasp(model, energy, near, {0.03, false}).palm_moved,
            !stays.result.grasp.form_closure && moves.result.grasp.form_closure);
  // The palm does not come to touch.
  EXPECT_FALSE(test_pregrasp(model, energy, far, {0.03, true}).palm_moved);
}

// One pose of eight would go round in circles for ever.
TEST(PlanGrasps, PreGraspsComeBackFromAQuaternionWithTheSameBits) {
  PlanOptions options = quick;
  options.grasps = 40;
  const PlanResult result = plan_grasps(block_scene(), options);
  ASSERT_GT(result.grasps.size(), 20u);
  for (const Grasp& g : result.grasps)
    EXPECT_EQ(make_pose(orientation(g.X_OH_pregrasp), g.X_OH_pregrasp.translation()).matrix(),
              g.X_OH_pregrasp.matrix());
}

TEST(PlanGrasps, MilestonesFallAndCountsAddUp) {
  PlanOptions options = quick;
  options.iterations = 2000;
  const PlanResult result = plan_grasps(block_scene(), options);
  ASSERT_FALSE(result.milestones.empty());
  for (std::size_t i = 1; i < result.milestones.size(); ++i) {
    EXPECT_LT(result.milestones[i].energy, result.milestones[i - 1].energy);
    EXPECT_GT(result.milestones[i].iteration, result.milestones[i - 1].iteration);
  }
  const StateCounts& s = result.states;
  EXPECT_EQ(s.evaluated, 2000);
  EXPECT_EQ(s.legal + s.hit_object + s.hit_itself + s.hit_obstacle, s.evaluated);
  const CandidateCounts& c = result.candidates;
  EXPECT_EQ(c.form_closed + c.not_closed + c.no_contact + c.penetrating, c.tested);
}

TEST(PlanGrasps, TheWrenchEnergyPlansToo) {
  PlanOptions options = quick;
  options.iterations = 1500;
  options.energy = EnergyKind::wrench;
  const PlanResult result = plan_grasps(block_scene(), options);
  EXPECT_GT(result.candidates.tested, 0) << result.explanation;
  ASSERT_FALSE(result.grasps.empty());
  EXPECT_EQ(result.grasps[0].provenance.planner, "staged/wrench");
}

TEST(PlanGrasps, JudgingAllStatesChangesNothingButTheirCounts) {
  const Scene scene = block_scene();
  PlanOptions options = quick;
  PlanResult some = plan_grasps(scene, options);
  options.judge_all = true;
  const PlanResult all = plan_grasps(scene, options);
  ASSERT_FALSE(all.grasps.empty());
  EXPECT_LT(all.states.legal, some.states.legal) << "states of high energy that collide";
  some.states = all.states;
  some.explanation = all.explanation;
  expect_same(some, all);
}

TEST(PlanGrasps, ThePapersSearchClosesWhatItKeepsAndTheStagedOneMore) {
  PlanOptions options = quick;
  options.search = SearchKind::paper;
  const PlanResult paper = plan_grasps(block_scene(), options);
  EXPECT_EQ(paper.states.evaluated, 6000);
  ASSERT_FALSE(paper.grasps.empty()) << paper.explanation;
  EXPECT_EQ(paper.grasps[0].provenance.planner, "annealing/contact");
  EXPECT_EQ(paper.candidates.tested, static_cast<int>(paper.grasps.size()) + paper.candidates.penetrating);
  const PlanResult staged = plan_grasps(block_scene(), quick);
  EXPECT_EQ(staged.grasps[0].provenance.planner, "staged/contact");
  EXPECT_EQ(staged.candidates.tested, static_cast<int>(staged.grasps.size()) + staged.candidates.penetrating);
  EXPECT_GT(staged.closed_on_the_way, staged.candidates.tested);
  EXPECT_EQ(paper.closed_on_the_way, paper.candidates.tested);
  const auto closed = [](const PlanResult& r) {
    return std::count_if(r.grasps.begin(), r.grasps.end(), [](const Grasp& g) { return g.form_closure; });
  };
  EXPECT_GE(closed(staged), closed(paper));
}

TEST(PlanGrasps, TemperingFindsTheSameOnOneAndOnTwoThreads) {
  PlanOptions options = quick;
  options.search = SearchKind::tempering;
  options.chains = 32;
  const PlanResult one = plan_grasps(block_scene(), options);
  options.threads = 2;
  const PlanResult two = plan_grasps(block_scene(), options);
  expect_same(one, two);
  EXPECT_EQ(one.status, PlanStatus::found) << one.explanation;
  EXPECT_EQ(one.states.evaluated, 6000);
  EXPECT_EQ(one.grasps[0].provenance.planner, "tempering/contact");
}

TEST(PlanGrasps, AvoidsTheTable) {
  Scene scene = block_scene();
  scene.obstacles.push_back(make_table(-0.02));
  const PlanResult result = plan_grasps(scene, quick);
  EXPECT_GT(result.states.hit_obstacle, 0);
  const CollisionModel exact = testing::exact_model(scene);
  std::vector<Pose> X_OL;
  for (const Grasp& g : result.grasps) {
    compute_link_poses(*scene.hand, joint_values(*scene.hand, g.pregrasp_dofs), g.X_OH_pregrasp, X_OL);
    EXPECT_EQ(exact.check_exact(X_OL), Legality::legal);
  }
}

TEST(PlanGrasps, TheStopFlagEndsAnEndlessSearch) {
  StopFlag stop;
  PlanOptions options = quick;
  options.iterations = 1000000000000;
  options.stop = &stop;
  options.time_limit = 60.0;
  int calls = 0;
  options.progress = [&](const PlanProgress& p) {
    ++calls;
    EXPECT_EQ(p.iterations_total, options.iterations);
    stop.request_stop();
  };
  const PlanResult result = plan_grasps(block_scene(), options);
  EXPECT_TRUE(result.stopped_early);
  EXPECT_GE(calls, 1);
  EXPECT_LT(result.states.evaluated, options.iterations);
}

TEST(PlanGrasps, ATimeLimitAloneIsEnough) {
  PlanOptions options = quick;
  options.iterations = 0;
  options.time_limit = 0.3;
  const PlanResult result = plan_grasps(block_scene(), options);
  EXPECT_GT(result.states.evaluated, 0);
  EXPECT_FALSE(result.explanation.empty());
}

TEST(PlanGrasps, SaysThatAnObjectIsFarTooLargeOrFarTooSmall) {
  PlanOptions options = quick;
  options.iterations = 300;
  const auto hand = block_scene().hand;
  const PlanResult large = plan_grasps(scene_of(hand, solid(box_mesh({1.2, 0.3, 0.3}))), options);
  EXPECT_NE(large.status, PlanStatus::found);
  EXPECT_NE(large.explanation.find("too large"), std::string::npos) << large.explanation;
  EXPECT_NE(large.explanation.find("300 states"), std::string::npos) << large.explanation;
  const PlanResult small = plan_grasps(scene_of(hand, solid(box_mesh({0.001, 0.001, 0.001}))), options);
  EXPECT_NE(small.status, PlanStatus::found);
  EXPECT_NE(small.explanation.find("too small"), std::string::npos) << small.explanation;
}

TEST(PlanGrasps, UnsoundOptionsAreAnError) {
  PlanOptions options = quick;
  options.grasps = 0;
  options.chains = 0;
  try {
    plan_grasps(block_scene(), options);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "grasps is 0, expected 1 to 100000; chains is 0, expected 1 to 4096");
  }
}

}  // namespace
}  // namespace eigengrasp
