// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/grasp_planner.hpp"

#include <algorithm>
#include <stdexcept>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/core/version.hpp"
#include "planning/plan_summary.hpp"
#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

namespace {

void require_sound(const PlanOptions& options, const Scene& scene) {
  if (options.search == SearchKind::transfer) throw std::logic_error("plan_grasps: a transfer has no search");
  const auto violations = options.validate(*scene.hand);
  if (violations.empty()) return;
  std::string all = violations.front();
  for (std::size_t i = 1; i < violations.size(); ++i) all += "; " + violations[i];
  throw Error(all);
}

/// The grasps of a search, the best first, with where they came from.
void take_over(SearchResult& found, const GraspEnergy& energy, const PlanOptions& options,
               PlanResult& result) {
  if (options.volumes)
    parallel_for(found.kept.size(), options.threads,
                 [&](std::size_t i, int) { add_volume(energy, found.kept[i].result.grasp); });
  result.states = found.states;
  result.candidates = found.candidates;
  result.closed_on_the_way = found.closed_on_the_way;
  result.milestones = std::move(found.milestones);
  for (TestedPreGrasp& t : found.kept) {
    if (t.result.outcome == CandidateOutcome::penetrating) continue;  // not a grasp
    t.result.grasp.provenance = {planner_name(options), options.seed, options_digest(options), version()};
    result.grasps.push_back(std::move(t.result.grasp));
  }
  std::stable_sort(result.grasps.begin(), result.grasps.end(), [](const Grasp& a, const Grasp& b) {
    if (a.form_closure != b.form_closure) return a.form_closure;
    return a.form_closure ? a.epsilon > b.epsilon : a.energy < b.energy;
  });
}

}  // namespace

PlanResult plan_grasps(const Scene& scene, const PlanOptions& options) {
  require_sound(options, scene);
  StopWatch watch;
  // What the hand can hit.
  CollisionModel::Options collision;
  collision.threads = options.threads;
  collision.cache = options.cache;
  const CollisionModel model(scene, collision);
  const double seconds = watch.lap();
  PlanResult result = plan_grasps(model, options);
  result.timings.prepare += seconds;
  result.timings.total += seconds;
  return result;
}

PlanResult plan_grasps(const CollisionModel& model, const PlanOptions& options) {
  const Scene& scene = model.scene();
  require_sound(options, scene);
  PlanResult result;
  StopWatch whole;
  StopWatch watch;

  // How good a pre-grasp is.
  const GraspEnergy energy(model, options);
  const SearchSpace space(scene, options.amplitudes);
  const StateEvaluator evaluator(model, space.postures, options.alpha);
  result.timings.prepare = watch.lap();

  // Search eigengrasp space and wrist pose for pre-grasps; close the fingers of the best ones.
  PlanBudget budget(options);
  const Annealer::Task task{model,
                            energy,
                            space,
                            evaluator,
                            AnnealingSchedule{},
                            options.seed,
                            options.judge_all,
                            options.search == SearchKind::tempering};
  SearchResult found = options.search == SearchKind::paper      ? search_as_the_paper(task, options, budget)
                       : options.search == SearchKind::enhanced ? search_with_children(task, options, budget)
                                                                : search_in_stages(task, options, budget);
  result.stopped_early = budget.ended_early();
  result.timings.search = found.search_seconds;
  result.timings.anneal = found.anneal_seconds;
  result.timings.close = found.close_seconds;
  watch.lap();
  take_over(found, energy, options, result);
  result.timings.volume = watch.lap();

  result.timings.total = whole.lap();
  explain(scene, options, result);
  return result;
}

}  // namespace eigengrasp
