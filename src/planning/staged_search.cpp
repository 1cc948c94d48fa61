// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cstdlib>

#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

namespace {
int knob(const char* name, int value) {
  const char* t = std::getenv(name);
  return t ? std::atoi(t) : value;
}
double knobd(const char* name, double value) {
  const char* t = std::getenv(name);
  return t ? std::atof(t) : value;
}

constexpr std::int64_t round_length = 20000;  ///< states of a stage, where only a time limit is given

/// Everything that was closed so far, and which of it is worth keeping.
class Harvest {
 public:
  Harvest(const Annealer::Task& task, const PlanOptions& options)
      : task_(task), options_(options), distinct_(distinctness_of(*task.model.scene().hand)) {}

  /// Closes the best pre-grasps of the annealers that are unlike all that was closed before.
  void gather(const std::vector<Annealer>& annealers, std::size_t most) {
    std::vector<PreGrasp> pool;
    for (const Annealer& a : annealers)
      pool.insert(pool.end(), a.best().items().begin(), a.best().items().end());
    std::stable_sort(pool.begin(), pool.end(),
                     [](const PreGrasp& a, const PreGrasp& b) { return a.energy < b.energy; });
    std::vector<PreGrasp> chosen;
    for (const PreGrasp& p : pool) {
      if (chosen.size() == most) break;
      if (is_new(p, chosen)) chosen.push_back(p);
    }
    auto tested = test_all(task_, std::move(chosen), options_);
    for (TestedPreGrasp& t : tested) tested_.push_back(std::move(t));
  }

  int closed() const {
    return static_cast<int>(std::count_if(
        tested_.begin(), tested_.end(), [](const TestedPreGrasp& t) { return t.result.grasp.form_closure; }));
  }
  const std::vector<TestedPreGrasp>& all() const { return tested_; }

  /// Distinct pre-grasps, those that closed by rising energy first.
  std::vector<TestedPreGrasp> best() const {
    std::vector<const TestedPreGrasp*> order;
    for (const TestedPreGrasp& t : tested_) order.push_back(&t);
    std::stable_sort(order.begin(), order.end(), [](const TestedPreGrasp* a, const TestedPreGrasp* b) {
      const bool ca = a->result.grasp.form_closure;
      const bool cb = b->result.grasp.form_closure;
      if (ca != cb) return ca;
      return ca ? a->result.grasp.epsilon > b->result.grasp.epsilon : a->pregrasp.energy < b->pregrasp.energy;
    });
    std::vector<TestedPreGrasp> kept;
    for (const TestedPreGrasp* t : order) {
      if (static_cast<int>(kept.size()) == options_.grasps) break;
      const bool distinct = std::none_of(kept.begin(), kept.end(), [&](const TestedPreGrasp& k) {
        return distinct_.between(k.pregrasp, t->pregrasp) < 1.0;
      });
      if (distinct) kept.push_back(*t);
    }
    return kept;
  }

 private:
  bool is_new(const PreGrasp& p, const std::vector<PreGrasp>& chosen) const {
    const auto alike = [&](const PreGrasp& other) { return distinct_.between(p, other) < 1.0; };
    return std::none_of(chosen.begin(), chosen.end(), alike) &&
           std::none_of(tested_.begin(), tested_.end(),
                        [&](const TestedPreGrasp& t) { return alike(t.pregrasp); });
  }

  const Annealer::Task& task_;
  const PlanOptions& options_;
  Distinctness distinct_;
  std::vector<TestedPreGrasp> tested_;
};

}  // namespace

SearchResult search_in_stages(const Annealer::Task& given, const PlanOptions& options, PlanBudget& budget) {
  Annealer::Task task = given;
  task.schedule.first_k = knobd("K0", 30000);
  task.schedule.last_k = knobd("K1", 70000);
  const HandModel& hand = *task.model.scene().hand;
  const int squads = knob("SQUADS", 4);
  const int stages = knob("STAGES", 4);
  const auto tests = static_cast<std::size_t>(knob("TESTS", 2) * options.grasps);
  const PreGraspList list(static_cast<std::size_t>(knob("LIST", 40)), distinctness_of(hand));
  std::vector<Annealer> annealers;
  for (int i = 0; i < squads; ++i) annealers.emplace_back(task, static_cast<std::uint64_t>(i), 16, list);

  Harvest harvest(task, options);
  RandomStream random{task.seed, 1000000};
  for (int stage = 0; (stage < stages || budget.repeats()) && !budget.ended(); ++stage) {
    const std::int64_t states =
        budget.repeats()
            ? round_length
            : part_of(options.iterations, static_cast<std::size_t>(stage), static_cast<std::size_t>(stages));
    parallel_for(annealers.size(), options.threads, [&](std::size_t i, int worker) {
      budget.anneal(annealers[i], part_of(states, i, annealers.size()), worker);
    });
    harvest.gather(annealers, tests);
    for (Annealer& a : annealers) {
      a.forget();
      a.restart();
    }
    // some chains begin at what closed
    std::vector<const TestedPreGrasp*> seeds;
    for (const auto& t : harvest.all())
      if (t.result.grasp.form_closure) seeds.push_back(&t);
    if (!seeds.empty())
      for (Annealer& a : annealers)
        for (int c = 0; c < knob("SEEDED", 8); ++c) {
          const auto& s =
              *seeds[static_cast<std::size_t>(random.uniform() * static_cast<double>(seeds.size()))];
          HandState state;
          state.q_OA = Eigen::Quaterniond(s.pregrasp.X_OH.linear());
          state.p_OA = s.pregrasp.X_OH * hand.approach_point_H;
          state.amplitudes = s.pregrasp.amplitudes;
          a.restart(c, state);
        }
  }
  SearchResult result;
  summarise_annealers(annealers, result);
  result.kept = harvest.best();
  count_outcomes(knob("COUNTALL", 0) ? harvest.all() : result.kept, result.candidates);
  return result;
}

}  // namespace eigengrasp
