// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/online_trial.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double step = 0.01;  // [s] of the operator, and of real time
constexpr auto poll = std::chrono::milliseconds(1);
constexpr double early_way = 0.5;  // of the way to the pre-grasp: a moment of Fig. 8

class OnlineTrial {
 public:
  OnlineTrial(std::shared_ptr<const CollisionModel> model, const OnlineTrialOptions& options)
      : model_(std::move(model)), options_(options) {
    trial_.hand = model_->scene().hand->name;
    trial_.object = model_->scene().object->name;
  }

  OnlineSceneTrial run() {
    measure_first_grasps();
    follow_operator();
    return std::move(trial_);
  }

 private:
  bool stopped() const { return options_.stop && options_.stop->stop_requested(); }

  OnlineView timed_update(OnlinePlanner& planner) {
    const StopWatch watch;
    OnlineView view = planner.update();
    trial_.updates.push_back(watch.seconds());
    return view;
  }

  /// Each direction anew: nothing that was found for the one before counts.
  void measure_first_grasps() {
    OnlinePlanner planner(model_, options_.online);
    SimulatedOperator person(model_->scene(), options_.traits, options_.seed);
    OnlineView view;
    double time = 0.0;
    for (int i = 0; i < options_.directions && !stopped(); ++i) {
      person.begin();
      (void)planner.command(OperatorCommand::forget);
      (void)planner.set_wrist({time += 10.0, person.wrist()});
      double first = std::numeric_limits<double>::infinity();
      const StopWatch watch;
      while (watch.seconds() < options_.time_limit && !stopped()) {
        std::this_thread::sleep_for(poll);
        view = planner.update();
        if (view.rates.time_to_first_grasp == 0.0) continue;
        first = view.rates.time_to_first_grasp;
        break;
      }
      trial_.first_grasp.push_back(first);
    }
  }

  void follow_operator() {
    OnlinePlanner planner(model_, options_.online);
    SimulatedOperator person(model_->scene(), options_.traits, options_.seed + 1);
    for (int i = 0; i < options_.approaches && !stopped(); ++i) {
      person.begin();
      (void)planner.command(OperatorCommand::open);
      (void)planner.command(OperatorCommand::forget);
      trial_.approaches.push_back(follow_approach(planner, person));
    }
    const OnlineRates rates = planner.update().rates;
    trial_.postures_per_second = rates.postures_per_second;
    trial_.candidates_per_second = rates.candidates_per_second;
    trial_.candidates = rates.candidates;
    trial_.form_closed = rates.form_closed;
  }

  OnlineApproach follow_approach(OnlinePlanner& planner, SimulatedOperator& person) {
    OnlineApproach approach;
    std::vector<OnlineMoment> moments;
    const double began = person.time();
    auto next = Clock::now();
    while (person.time() - began < options_.give_up && !stopped()) {
      next += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(step));
      std::this_thread::sleep_until(next);
      const OnlineView view = timed_update(planner);
      remember(planner, view, moments);
      const OperatorAction action = person.step(view, step);
      for (const WristSample& sample : action.samples) (void)planner.set_wrist(sample);
      if (!action.command) continue;
      approach.clicked = true;
      const std::optional<Grasp> grasp = planner.command(*action.command);
      approach.form_closed = grasp && grasp->form_closure;
      approach.epsilon = grasp ? grasp->epsilon : 0.0;
      if (approach.form_closed) finish(planner.update(), view, *grasp, moments);
      break;
    }
    approach.seconds = person.time() - began;
    approach.directions = person.directions();
    return approach;
  }

  /// The moments of Fig. 8: the approach, the offer, half way to it, the pre-grasp; of one direction only.
  void remember(const OnlinePlanner& planner, const OnlineView& view, std::vector<OnlineMoment>& moments) {
    if (view.phase != OnlinePhase::approach || !trial_.moments.empty()) return;
    const auto add = [&](const char* title) {
      std::optional<Grasp> offer;
      if (view.offer) offer = planner.solution(view.offer->id);
      moments.push_back({title, view.X_OH, view.joints, offer, {}});
    };
    if (moments.empty()) {
      add("approach");
    } else if (moments.size() == 1 && view.offer) {
      add("a grasp is offered");
    } else if (moments.size() == 2 && view.offer && view.preshape > early_way) {
      add("fingers preshape");
    }
  }

  void finish(const OnlineView& held, const OnlineView& before, const Grasp& grasp,
              std::vector<OnlineMoment>& moments) {
    if (moments.size() < 3) return;
    moments.push_back({"pre-grasp", before.X_OH, before.joints, {}, {}});
    moments.push_back({"closed", held.X_OH, held.joints, {}, grasp});
    if (trial_.moments.empty()) trial_.moments = std::move(moments);
  }

  std::shared_ptr<const CollisionModel> model_;
  const OnlineTrialOptions& options_;
  OnlineSceneTrial trial_;
};

}  // namespace

OnlineSceneTrial try_online(std::shared_ptr<const CollisionModel> model, const OnlineTrialOptions& options) {
  return OnlineTrial(std::move(model), options).run();
}

}  // namespace eigengrasp
