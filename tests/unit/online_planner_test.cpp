// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The online planner at work, driven by the simulated operator in simulated time: what it shows and offers is
// checked with exact meshes and by closing anew.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/online/online_planner.hpp"
#include "eigengrasp/online/simulated_operator.hpp"
#include "support/shipped_scenes.hpp"

namespace eigengrasp {
namespace {

std::shared_ptr<const CollisionModel> barrett_and_flask() {
  static const auto model = std::make_shared<const CollisionModel>(
      testing::shipped_scene("barrett-rubber", "flask"), CollisionModel::Options{});
  return model;
}

/// Moves until the operator clicks; the planner gets some real time for each step of the simulated operator.
std::optional<Grasp> approach(OnlinePlanner& planner, SimulatedOperator& person,
                              const CollisionModel& model) {
  std::vector<Pose> X_OL;
  for (int i = 0; i < 6000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const OnlineView view = planner.update();
    if (i % 20 == 0 && view.phase == OnlinePhase::approach) {
      compute_link_poses(*model.scene().hand, view.joints, view.X_OH, X_OL);
      EXPECT_EQ(model.check_exact(X_OL), Legality::legal) << "shown in collision in step " << i;
    }
    const OperatorAction action = person.step(view, 0.01);
    for (const WristSample& s : action.samples) (void)planner.set_wrist(s);
    if (action.command) return planner.command(*action.command);
  }
  ADD_FAILURE() << "no offer that the operator took in a minute of its time";
  return std::nullopt;
}

TEST(OnlinePlanner, OperatorsApproachesEndInGraspsThatHold) {
  const auto model = barrett_and_flask();
  OnlinePlanner planner(model, {});
  EXPECT_EQ(planner.update().phase, OnlinePhase::waiting);
  EXPECT_FALSE(planner.command(OperatorCommand::close).has_value()) << "nothing to close yet";
  SimulatedOperator person(model->scene(), {}, 5);
  int closed = 0;
  constexpr int approaches = 6;
  for (int k = 0; k < approaches; ++k) {
    person.begin();
    (void)planner.command(OperatorCommand::forget);
    const std::optional<Grasp> grasp = approach(planner, person, *model);
    closed += grasp && grasp->form_closure;
    if (!grasp) continue;
    const OnlineView held = planner.update();
    EXPECT_EQ(held.phase, OnlinePhase::holding);
    EXPECT_EQ(held.epsilon_now.value() > 0.0, grasp->form_closure);
    std::vector<Pose> X_OL;
    compute_link_poses(*model->scene().hand, held.joints, held.X_OH, X_OL);
    EXPECT_LT(model->deepest_penetration(X_OL), 0.0005);
    (void)planner.command(OperatorCommand::open);
    EXPECT_EQ(planner.update().phase, OnlinePhase::approach);
  }
  EXPECT_GE(closed, approaches - 1);
  const OnlineRates rates = planner.update().rates;
  EXPECT_GT(rates.postures, 1000);
  EXPECT_GT(rates.form_closed, 0);
  EXPECT_GE(rates.candidates, rates.form_closed);
}

TEST(OnlinePlanner, SolutionsAreFormClosedAndCanBeAskedFor) {
  const auto model = barrett_and_flask();
  OnlinePlanner planner(model, {});
  SimulatedOperator person(model->scene(), {}, 7);
  (void)planner.set_wrist({0.0, person.wrist()});
  OnlineView view;
  for (int i = 0; i < 20000 && !view.offer; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    view = planner.update();
  }
  ASSERT_TRUE(view.offer.has_value());
  EXPECT_GT(view.rates.time_to_first_grasp, 0.0);
  const std::optional<Grasp> grasp = planner.solution(view.offer->id);
  ASSERT_TRUE(grasp.has_value());
  EXPECT_TRUE(grasp->form_closure);
  EXPECT_EQ(grasp->epsilon, view.offer->epsilon);
  EXPECT_EQ(grasp->X_OH_pregrasp.matrix(), view.offer_X_OH.matrix());
  EXPECT_FALSE(planner.solution(1u << 30).has_value());
  (void)planner.command(OperatorCommand::forget);
  EXPECT_FALSE(planner.solution(view.offer->id).has_value());
}

TEST(OnlinePlanner, TakesInputFromManyThreads) {
  const auto model = barrett_and_flask();
  OnlineOptions options;
  options.test_threads = 2;
  OnlinePlanner planner(model, options);
  const Pose wrist = SimulatedOperator(model->scene(), {}, 9).wrist();
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i) {
        (void)planner.set_wrist({0.001 * (4 * i + t), wrist});
        (void)planner.update();
        if (i % 10 == 5) planner.set_targets({{VariableTarget::Variable::amplitude, 0, 0.1 * t, 0.5}});
        if (i % 25 == 24) (void)planner.command(t % 2 == 0 ? OperatorCommand::close : OperatorCommand::open);
      }
    });
  threads.clear();
  EXPECT_GT(planner.update().frame, 200u);
}

TEST(OnlinePlanner, RefusesOptionsThatAreNotSound) {
  OnlineOptions options;
  options.look_ahead = -1.0;
  EXPECT_THROW(OnlinePlanner(barrett_and_flask(), options), Error);
}

}  // namespace
}  // namespace eigengrasp
