// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/pregrasp_search.hpp"

#include <algorithm>

namespace eigengrasp {

Distinctness distinctness_of(const HandModel& hand) {
  Distinctness d;
  d.approach_point_H = hand.approach_point_H;
  return d;
}

std::vector<TestedPreGrasp> test_all(const Annealer::Task& task, std::vector<PreGrasp> pregrasps,
                                     const PlanOptions& options) {
  std::vector<TestedPreGrasp> tested(pregrasps.size());
  parallel_for(pregrasps.size(), options.threads, [&](std::size_t i, int) {
    if (options.stop && options.stop->stop_requested()) return;
    if (!make_exactly_legal(task.model, task.energy, pregrasps[i])) return;
    tested[i].result = test_candidate(task.model, task.energy, pregrasps[i]);
    tested[i].result.tests = 1;
    tested[i].pregrasp = std::move(pregrasps[i]);
  });
  std::erase_if(tested, [](const TestedPreGrasp& t) { return t.result.tests == 0; });
  return tested;
}

void count_outcomes(const std::vector<TestedPreGrasp>& tested, CandidateCounts& counts) {
  for (const TestedPreGrasp& t : tested) {
    ++counts.tested;
    switch (t.result.outcome) {
      case CandidateOutcome::form_closed:
        ++counts.form_closed;
        break;
      case CandidateOutcome::not_closed:
        ++counts.not_closed;
        break;
      case CandidateOutcome::no_contact:
        ++counts.no_contact;
        break;
      case CandidateOutcome::penetrating:
        ++counts.penetrating;
        break;
    }
  }
}

void summarise_annealers(const std::vector<Annealer>& annealers, SearchResult& result) {
  const Annealer* best = nullptr;
  for (const Annealer& annealer : annealers) {
    const StateCounts& c = annealer.counts();
    result.states.evaluated += c.evaluated;
    result.states.legal += c.legal;
    result.states.hit_object += c.hit_object;
    result.states.hit_itself += c.hit_itself;
    result.states.hit_obstacle += c.hit_obstacle;
    if (annealer.milestones().empty()) continue;
    if (!best || annealer.milestones().back().energy < best->milestones().back().energy) best = &annealer;
  }
  if (best) result.milestones = best->milestones();
}

}  // namespace eigengrasp
