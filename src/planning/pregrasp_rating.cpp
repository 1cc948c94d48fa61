// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/pregrasp_rating.hpp"

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/core/version.hpp"
#include "eigengrasp/planning/pregrasp_fitting.hpp"
#include "planning/plan_summary.hpp"
#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

namespace {

constexpr double least_forwards = 0.001;  // [m] below, closing where it was free is no second try

struct Tried {
  TestedPreGrasp tested;
  int tests = 0;
  GivenOutcome outcome = GivenOutcome::skipped;
};

GivenOutcome outcome_of(const TestedPreGrasp& tested) {
  if (tested.result.tests == 0) return GivenOutcome::unfit;
  switch (tested.result.outcome) {
    case CandidateOutcome::form_closed:
      return GivenOutcome::form_closed;
    case CandidateOutcome::not_closed:
      return GivenOutcome::not_closed;
    case CandidateOutcome::no_contact:
      return GivenOutcome::no_contact;
    case CandidateOutcome::penetrating:
      break;
  }
  return GivenOutcome::penetrating;
}

EigengraspSpace searched_space(const HandModel& hand, int amplitudes) {
  return hand.eigengrasps.with_size(amplitudes, hand.dof_min(), hand.dof_max());
}

class Rating {
 public:
  Rating(const CollisionModel& model, const PlanOptions& options, double min_epsilon)
      : model_(model),
        options_(options),
        min_epsilon_(min_epsilon),
        energy_(model, options),
        postures_(searched_space(*model.scene().hand, options.amplitudes)) {}

  RatedPreGrasps run(const std::vector<GivenPreGrasp>& given);

 private:
  Tried try_one(const GivenPreGrasp& given) const;
  TestedPreGrasp test_at(const Pose& X_OH, const VecX& dofs) const;
  std::vector<std::size_t> pick_distinct(const std::vector<Tried>& tried) const;
  void finish_grasps(std::vector<Grasp>& grasps) const;
  bool ended() const {
    return (options_.stop != nullptr && options_.stop->stop_requested()) ||
           (options_.time_limit > 0.0 && since_start_.seconds() >= options_.time_limit);
  }

  const CollisionModel& model_;
  const PlanOptions& options_;
  double min_epsilon_;
  GraspEnergy energy_;
  EigengraspSpace postures_;
  StopWatch since_start_;
};

TestedPreGrasp Rating::test_at(const Pose& X_OH, const VecX& dofs) const {
  PreGrasp p;
  p.X_OH = X_OH;
  p.dofs = dofs;
  p.amplitudes = postures_.project(dofs);
  return test_pregrasp(model_, energy_, std::move(p), {});
}

Tried Rating::try_one(const GivenPreGrasp& given) const {
  Tried tried;
  tried.outcome = GivenOutcome::unfit;
  const FittedPreGrasp fitted = fit_pregrasp(model_, given.X_OH, given.dofs);
  if (!fitted.free) return tried;
  tried.tested = test_at(fitted.X_OH, fitted.dofs);
  tried.tests = tried.tested.result.tests;
  if (!tried.tested.result.grasp.form_closure && fitted.forwards >= least_forwards) {
    TestedPreGrasp farther = test_at(fitted.X_OH_free, fitted.dofs);
    tried.tests += farther.result.tests;
    if (farther.result.grasp.form_closure || tried.tested.result.tests == 0)
      tried.tested = std::move(farther);
  }
  tried.outcome = outcome_of(tried.tested);
  if (tried.outcome == GivenOutcome::form_closed && !(tried.tested.result.grasp.epsilon > min_epsilon_))
    tried.outcome = GivenOutcome::not_closed;
  return tried;
}

/// The best first; of equally good ones that which was given first.
std::vector<std::size_t> Rating::pick_distinct(const std::vector<Tried>& tried) const {
  const Distinctness distinct = distinctness_of(*model_.scene().hand);
  std::vector<std::size_t> closed, kept;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (tried[i].outcome == GivenOutcome::form_closed) closed.push_back(i);
  std::stable_sort(closed.begin(), closed.end(), [&](std::size_t a, std::size_t b) {
    return tried[a].tested.result.grasp.epsilon > tried[b].tested.result.grasp.epsilon;
  });
  for (const std::size_t i : closed)
    if (std::none_of(kept.begin(), kept.end(), [&](std::size_t k) {
          return distinct.between(tried[k].tested.pregrasp, tried[i].tested.pregrasp) < 1.0;
        }))
      kept.push_back(i);
  return kept;
}

void Rating::finish_grasps(std::vector<Grasp>& grasps) const {
  if (options_.volumes)
    parallel_for(grasps.size(), options_.threads,
                 [&](std::size_t i, int) { add_volume(energy_, grasps[i]); });
  for (Grasp& g : grasps)
    g.provenance = {planner_name(options_), options_.seed, options_digest(options_), version()};
}

RatedPreGrasps Rating::run(const std::vector<GivenPreGrasp>& given) {
  RatedPreGrasps rated;
  StopWatch lap;
  std::vector<Tried> tried(given.size());
  parallel_for(given.size(), options_.threads, [&](std::size_t i, int) {
    if (!ended()) tried[i] = try_one(given[i]);
  });
  PlanResult& plan = rated.plan;
  for (const Tried& t : tried) {
    rated.outcomes.push_back(t.outcome);
    plan.closed_on_the_way += t.tests;
    plan.stopped_early = plan.stopped_early || t.outcome == GivenOutcome::skipped;
    if (t.tests > 0) count_outcomes({&t.tested, 1}, plan.candidates);
  }
  rated.origins = pick_distinct(tried);
  rated.distinct = static_cast<int>(rated.origins.size());
  rated.origins.resize(std::min(rated.origins.size(), static_cast<std::size_t>(options_.grasps)));
  plan.timings.close = lap.lap();
  for (const std::size_t i : rated.origins) plan.grasps.push_back(std::move(tried[i].tested.result.grasp));
  finish_grasps(plan.grasps);
  plan.timings.volume = lap.lap();
  plan.timings.total = plan.timings.close + plan.timings.volume;
  plan.status = !plan.grasps.empty()         ? PlanStatus::found
                : plan.candidates.tested > 0 ? PlanStatus::none_closed
                                             : PlanStatus::nothing_legal;
  return rated;
}

}  // namespace

RatedPreGrasps rate_pregrasps(const CollisionModel& model, const std::vector<GivenPreGrasp>& given,
                              const PlanOptions& options, double min_epsilon) {
  if (const auto violations = options.validate(*model.scene().hand); !violations.empty())
    throw Error(violations.front());
  return Rating(model, options, min_epsilon).run(given);
}

}  // namespace eigengrasp
