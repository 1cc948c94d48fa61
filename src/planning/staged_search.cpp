// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>

#include "core/lanes.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "planning/harvest.hpp"
#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

namespace {

constexpr int chains_of_annealer = kernel::n_lanes;
constexpr int most_stages = 12;
constexpr std::int64_t least_steps = 60;  ///< of a chain in a stage
constexpr std::int64_t steps_without_budget =
    200;                               ///< of a chain in a stage, where only a time limit is given
constexpr int chains_that_return = 8;  ///< of an annealer: they begin near what closed
constexpr std::size_t list_size = 40;  ///< of an annealer, for one stage

int stages_for(const PlanOptions& options, int n_chains) {
  const std::int64_t stages = options.iterations / (n_chains * least_steps);
  return static_cast<int>(std::clamp<std::int64_t>(stages, 1, most_stages));
}

/// Pre-grasps to close after a stage: as many as are wanted in the end, fewer once that many close.
std::size_t tests_after_stage(const Harvest& harvest, const PlanOptions& options) {
  const auto wanted = static_cast<std::size_t>(options.grasps);
  return harvest.n_closed() >= wanted ? std::max<std::size_t>(1, wanted / 2) : wanted;
}

HandState state_of(const HandModel& hand, const PreGrasp& p) {
  return {p.X_OH * hand.approach_point_H, orientation(p.X_OH), p.amplitudes};
}

/// All chains begin anew: some near pre-grasps that closed, the others anywhere.
void begin_stage(std::vector<Annealer>& annealers, const Harvest& harvest, const HandModel& hand,
                 RandomStream& random) {
  for (Annealer& a : annealers) {
    a.forget();
    a.restart();
    for (int c = 0; c < chains_that_return && harvest.n_closed() > 0; ++c)
      a.restart(c, state_of(hand, harvest.draw_closed(random.uniform())));
  }
}

}  // namespace

SearchResult search_in_stages(const Annealer::Task& task, const PlanOptions& options, PlanBudget& budget) {
  const HandModel& hand = *task.model.scene().hand;
  const int n_annealers = (options.chains + chains_of_annealer - 1) / chains_of_annealer;
  std::vector<Annealer> annealers;
  for (int i = 0; i < n_annealers; ++i)
    annealers.emplace_back(task, static_cast<std::uint64_t>(i), chains_of_annealer,
                           PreGraspList(list_size, distinctness_of(hand)));
  const int n_chains = n_annealers * chains_of_annealer;
  const int n_stages = stages_for(options, n_chains);

  SearchResult result;
  Harvest harvest(task, options);
  RandomStream random{task.seed, static_cast<std::uint64_t>(n_annealers)};
  StopWatch watch;
  for (int stage = 0; (budget.repeats() || stage < n_stages) && !budget.ended(); ++stage) {
    if (stage > 0) begin_stage(annealers, harvest, hand, random);
    const std::int64_t states = budget.repeats()
                                    ? n_chains * steps_without_budget
                                    : part_of(options.iterations, static_cast<std::size_t>(stage),
                                              static_cast<std::size_t>(n_stages));
    parallel_for(annealers.size(), options.threads, [&](std::size_t i, int worker) {
      budget.anneal(annealers[i], part_of(states, i, annealers.size()), worker);
    });
    result.anneal_seconds += watch.lap();
    harvest.gather(annealers, tests_after_stage(harvest, options));
    result.close_seconds += watch.lap();
  }
  summarise_annealers(annealers, result);
  result.kept = harvest.best();
  count_outcomes(result.kept, result.candidates);
  result.closed_on_the_way = static_cast<int>(harvest.all().size());
  result.search_seconds = result.anneal_seconds + result.close_seconds;
  return result;
}

}  // namespace eigengrasp
