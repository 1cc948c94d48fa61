// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>

#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/planning/search_areas.hpp"
#include "planning/child_search.hpp"
#include "planning/kernel/program.hpp"

namespace eigengrasp {

namespace {

constexpr int chains_of_annealer = kernel::n_lanes;
constexpr std::int64_t steps_of_round = 250;  // of a chain, from hot to cold
constexpr std::size_t list_size = 40;         // of an annealer, for one round
/// Threshold of pre-grasps. Eq. (8) is below 0 where the virtual contacts enclose the origin, and the contact
/// energy [mm] elsewhere.
constexpr double highest_pregrasp = 60.0;
constexpr std::size_t least_children = 4;  // of a round
constexpr std::size_t most_children = 16;
constexpr std::size_t children_a_grasp = 8;    // in all, for each grasp that is wanted
constexpr std::size_t hopeless_children = 96;  // when none of so many has closed, the search ends
/// Children anneal once fewer than one in so many pre-grasps closes as it stands.
constexpr std::size_t seldom = 8;

/// A search with its parent's chains and all that its children have brought.
class EnhancedSearch {
 public:
  EnhancedSearch(const Annealer::Task& task, const PlanOptions& options, PlanBudget& budget)
      : options_(options),
        budget_(budget),
        distinct_(distinctness_of(*task.model.scene().hand)),
        areas_(*task.model.scene().hand, task.space, distinct_),
        task_(keeping_away(task, areas_)),
        children_(task_, budget) {
    const int n = (options.chains + chains_of_annealer - 1) / chains_of_annealer;
    for (int i = 0; i < n; ++i)
      annealers_.emplace_back(task_, static_cast<std::uint64_t>(i), chains_of_annealer,
                              PreGraspList(list_size, distinct_));
  }

  SearchResult run() {
    StopWatch watch;
    while (!done()) {
      anneal();
      result_.anneal_seconds += watch.lap();
      raise_children(take_pregrasps());
      result_.close_seconds += watch.lap();
    }
    return finish();
  }

 private:
  static Annealer::Task keeping_away(Annealer::Task task, const SearchAreas& areas) {
    task.avoided = &areas;
    return task;
  }

  bool done() const {
    if (budget_.ended() || kept_.size() >= wanted()) return true;
    if (budget_.repeats()) return false;
    const bool hopeless = kept_.empty() && n_children_ >= hopeless_children;
    return hopeless || n_children_ >= children_a_grasp * wanted() + hopeless_children ||
           spent() >= options_.iterations;
  }
  std::size_t wanted() const { return static_cast<std::size_t>(options_.grasps); }
  std::int64_t spent() const {
    std::int64_t states = result_.states.evaluated;  // of the children
    for (const Annealer& a : annealers_) states += a.iterations();
    return states;
  }

  void anneal();
  std::vector<PreGrasp> take_pregrasps();
  void raise_children(const std::vector<PreGrasp>& pregrasps);
  void take_in(ChildResult child);
  SearchResult finish();

  const PlanOptions& options_;
  PlanBudget& budget_;
  Distinctness distinct_;
  SearchAreas areas_;
  Annealer::Task task_;
  ChildSearch children_;
  std::vector<Annealer> annealers_;
  std::size_t n_children_ = 0;
  std::vector<TestedPreGrasp> kept_;  ///< form-closed and distinct
  SearchResult result_;
};

/// All chains from new starts, from hot to cold.
void EnhancedSearch::anneal() {
  for (Annealer& a : annealers_) {
    if (a.iterations() > 0) a.restart();
    a.forget();
  }
  const std::int64_t states = steps_of_round * chains_of_annealer;
  parallel_for(annealers_.size(), options_.threads,
               [&](std::size_t i, int worker) { budget_.anneal(annealers_[i], states, worker); });
}

/// Those past the threshold that lie in no child's area, the best first. Their areas are taken from now on.
std::vector<PreGrasp> EnhancedSearch::take_pregrasps() {
  std::vector<PreGrasp> pool;
  for (Annealer& a : annealers_) {
    const std::vector<PreGrasp>& best = a.best().items();
    pool.insert(pool.end(), best.begin(), best.end());
  }
  parallel_for(pool.size(), options_.threads, [&](std::size_t i, int) {
    pool[i].energy = compute_wrench_energy(task_.model, task_.energy, pool[i]);
  });
  std::stable_sort(pool.begin(), pool.end(),
                   [](const PreGrasp& a, const PreGrasp& b) { return a.energy < b.energy; });
  const std::size_t missing = wanted() - kept_.size();
  const std::size_t most = std::clamp(missing + missing / 4, least_children, most_children);
  std::vector<PreGrasp> taken;
  for (const PreGrasp& p : pool) {
    if (taken.size() == most || p.energy > highest_pregrasp) break;
    if (areas_.holds(p)) continue;
    areas_.add(p);
    taken.push_back(p);
  }
  return taken;
}

void EnhancedSearch::raise_children(const std::vector<PreGrasp>& pregrasps) {
  std::vector<ChildResult> results(pregrasps.size());
  const bool anneals = n_children_ > 0 && seldom * kept_.size() < n_children_;
  parallel_for(pregrasps.size(), options_.threads, [&](std::size_t i, int worker) {
    if (!budget_.ended())
      results[i] = children_.refine(pregrasps[i], annealers_.size() + n_children_ + i, anneals, worker);
  });
  n_children_ += pregrasps.size();
  for (ChildResult& child : results) take_in(std::move(child));
}

/// Of two grasps that are not distinct the one of the higher epsilon stays.
void EnhancedSearch::take_in(ChildResult child) {
  result_.states += child.states;
  result_.closed_on_the_way += child.tests;
  if (child.tested.result.tests == 0) return;
  count_outcomes({&child.tested, 1}, result_.candidates);
  if (!child.tested.result.grasp.form_closure) return;
  for (const TestedPreGrasp& k : kept_)
    if (distinct_.between(k.pregrasp, child.tested.pregrasp) < 1.0 &&
        k.result.grasp.epsilon >= child.tested.result.grasp.epsilon)
      return;
  std::erase_if(kept_, [&](const TestedPreGrasp& k) {
    return distinct_.between(k.pregrasp, child.tested.pregrasp) < 1.0;
  });
  kept_.push_back(std::move(child.tested));
}

SearchResult EnhancedSearch::finish() {
  std::stable_sort(kept_.begin(), kept_.end(), [](const TestedPreGrasp& a, const TestedPreGrasp& b) {
    return a.result.grasp.epsilon > b.result.grasp.epsilon;
  });
  if (kept_.size() > wanted()) kept_.resize(wanted());
  summarise_annealers(annealers_, result_);
  result_.kept = std::move(kept_);
  result_.search_seconds = result_.anneal_seconds + result_.close_seconds;
  return std::move(result_);
}

}  // namespace

SearchResult search_with_children(const Annealer::Task& task, const PlanOptions& options,
                                  PlanBudget& budget) {
  return EnhancedSearch(task, options, budget).run();
}

}  // namespace eigengrasp
