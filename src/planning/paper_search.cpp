// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/core/stop_watch.hpp"
#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

namespace {
/// More pre-grasps are kept than asked for: some fail the exact test.
constexpr std::size_t spare_factor = 2;
/// States of a round, where only a time limit is given.
constexpr std::int64_t round_length = 70000;
}  // namespace

SearchResult search_as_the_paper(const Annealer::Task& task, const PlanOptions& options, PlanBudget& budget) {
  const HandModel& hand = *task.model.scene().hand;
  const auto wanted = static_cast<std::size_t>(options.grasps);
  std::vector<Annealer> annealers;
  annealers.emplace_back(task, 0, 1, PreGraspList(spare_factor * wanted, distinctness_of(hand)));
  StopWatch watch;
  while (budget.anneal(annealers[0], budget.repeats() ? round_length : options.iterations, 0) &&
         budget.repeats())
    annealers[0].restart();

  SearchResult result;
  result.search_seconds = result.anneal_seconds = watch.lap();
  summarise_annealers(annealers, result);
  // Legal by exact meshes first, then the best that are still distinct, then close those.
  std::vector<PreGrasp> pool = annealers[0].best().items();
  std::vector<char> legal(pool.size());
  parallel_for(pool.size(), options.threads,
               [&](std::size_t i, int) { legal[i] = make_exactly_legal(task.model, task.energy, pool[i]); });
  PreGraspList best(wanted, distinctness_of(hand));
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (legal[i]) best.add(pool[i]);
  result.kept = test_all(task, best.items(), options, {});
  result.close_seconds = watch.lap();
  count_outcomes(result.kept, result.candidates);
  result.closed_on_the_way = result.candidates.tested;
  return result;
}

}  // namespace eigengrasp
