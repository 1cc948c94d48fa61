// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/grasp_planner.hpp"

#include <algorithm>
#include <chrono>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/version.hpp"
#include "eigengrasp/planning/annealer.hpp"
#include "planning/candidate_test.hpp"
#include "planning/plan_budget.hpp"
#include "planning/plan_summary.hpp"

namespace eigengrasp {

namespace {

/// More are kept than asked for: some fail the exact test.
constexpr std::size_t spare_factor = 2;

Distinctness distinctness(const HandModel& hand) {
  Distinctness d;
  d.approach_point_H = hand.approach_point_H;
  return d;
}

std::vector<AnnealingChain> make_chains(const CollisionModel& model, const GraspEnergy& energy,
                                        const SearchSpace& space, const PlanOptions& options) {
  const PreGraspList list(spare_factor * static_cast<std::size_t>(options.grasps),
                          distinctness(*model.scene().hand));
  std::vector<AnnealingChain> chains;
  const int n_chains = options.search == SearchKind::paper ? 1 : options.chains;
  for (int c = 0; c < n_chains; ++c)
    chains.emplace_back(model, energy, space, AnnealingSchedule{}, list,
                        RandomStream{options.seed, static_cast<std::uint64_t>(c)}, c);
  return chains;
}

/// Every chain runs its share of the iterations; without a limit on those, rounds of a fixed length until the
/// time is up.
void search(std::vector<AnnealingChain>& chains, PlanBudget& budget, int threads) {
  parallel_for(chains.size(), threads, [&](std::size_t c, int worker) {
    AnnealingChain& chain = chains[c];
    const std::int64_t share = budget.share_of_chain(c, chains.size());
    do {
      for (std::int64_t i = 0; i < share; ++i) {
        if (!budget.go_on(worker, chain)) return;
        chain.step(static_cast<double>(i) / static_cast<double>(share));
      }
      chain.restart();
    } while (budget.repeats());
  });
}

/// The best distinct pre-grasps of all chains that exact meshes call legal, by rising energy.
std::vector<PreGrasp> best_pregrasps(const CollisionModel& model, const GraspEnergy& energy,
                                     const std::vector<AnnealingChain>& chains, const PlanOptions& options) {
  std::vector<PreGrasp> pool;
  for (const AnnealingChain& chain : chains)
    pool.insert(pool.end(), chain.best().items().begin(), chain.best().items().end());
  std::vector<char> legal(pool.size());
  parallel_for(pool.size(), options.threads,
               [&](std::size_t i, int) { legal[i] = make_exactly_legal(model, energy, pool[i]); });
  PreGraspList best(static_cast<std::size_t>(options.grasps), distinctness(*model.scene().hand));
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (legal[i]) best.add(pool[i]);
  return best.items();
}

void test_all(const CollisionModel& model, const GraspEnergy& energy, const std::vector<PreGrasp>& pregrasps,
              const PlanOptions& options, PlanResult& result) {
  std::vector<CandidateResult> tested(pregrasps.size());
  parallel_for(pregrasps.size(), options.threads, [&](std::size_t i, int) {
    if (options.stop && options.stop->stop_requested()) return;
    tested[i] = test_candidate(model, energy, pregrasps[i]);
    ++tested[i].tests;
  });
  for (CandidateResult& candidate : tested) {
    if (candidate.tests == 0) continue;
    ++result.candidates.tested;
    switch (candidate.outcome) {
      case CandidateOutcome::form_closed:
        ++result.candidates.form_closed;
        break;
      case CandidateOutcome::not_closed:
        ++result.candidates.not_closed;
        break;
      case CandidateOutcome::no_contact:
        ++result.candidates.no_contact;
        break;
      case CandidateOutcome::penetrating:
        ++result.candidates.penetrating;
        continue;  // not a grasp
    }
    candidate.grasp.provenance = {planner_name(options), options.seed, options_digest(options), version()};
    result.grasps.push_back(std::move(candidate.grasp));
  }
  std::stable_sort(result.grasps.begin(), result.grasps.end(), [](const Grasp& a, const Grasp& b) {
    if (a.form_closure != b.form_closure) return a.form_closure;
    return a.form_closure ? a.epsilon > b.epsilon : a.energy < b.energy;
  });
}

void require_sound(const PlanOptions& options, const Scene& scene) {
  const auto violations = options.validate(*scene.hand);
  if (violations.empty()) return;
  std::string all = violations.front();
  for (std::size_t i = 1; i < violations.size(); ++i) all += "; " + violations[i];
  throw Error(all);
}

/// Seconds since the last call.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

PlanResult plan_grasps(const Scene& scene, const PlanOptions& options) {
  require_sound(options, scene);
  PlanResult result;
  StopWatch watch;

  // What the hand can hit, and how good a pre-grasp is.
  CollisionModel::Options collision;
  collision.threads = options.threads;
  collision.cache = options.cache;
  const CollisionModel model(scene, collision);
  const GraspEnergy energy(model, options);
  const SearchSpace space(scene, options.amplitudes);
  result.timings.prepare = watch.lap();

  // Search eigengrasp space and wrist pose for pre-grasps.
  PlanBudget budget(options);
  std::vector<AnnealingChain> chains = make_chains(model, energy, space, options);
  search(chains, budget, options.threads);
  summarise_search(chains, result);
  result.stopped_early = budget.ended_early();
  result.timings.search = watch.lap();

  // Close the fingers of the best ones, find the contacts, rate, check.
  const auto pregrasps = best_pregrasps(model, energy, chains, options);
  test_all(model, energy, pregrasps, options, result);
  result.timings.close = watch.lap();

  result.timings.total = result.timings.prepare + result.timings.search + result.timings.close;
  explain(scene, options, result);
  return result;
}

}  // namespace eigengrasp
