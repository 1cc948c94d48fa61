// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/pregrasp_search.hpp"

#include <algorithm>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/palm_approach.hpp"

namespace eigengrasp {

Distinctness distinctness_of(const HandModel& hand) {
  Distinctness d;
  d.approach_point_H = hand.approach_point_H;
  return d;
}

namespace {

/// The pre-grasp where it stands, once it is legal by exact meshes.
TestedPreGrasp test_in_place(const CollisionModel& model, const GraspEnergy& energy, PreGrasp pregrasp) {
  TestedPreGrasp tested;
  if (!make_exactly_legal(model, energy, pregrasp)) return tested;
  tested.result = test_candidate(model, energy, pregrasp);
  tested.result.tests = 1;
  tested.pregrasp = std::move(pregrasp);
  return tested;
}

/// The pre-grasp after the palm has moved up to the object; without test where the palm does not come to
/// touch.
TestedPreGrasp test_after_approach(const CollisionModel& model, const GraspEnergy& energy, PreGrasp pregrasp,
                                   double most_travel) {
  constexpr double least_travel = 0.001;  // [m] less is no other pre-grasp
  const VecX joints = joint_values(*model.scene().hand, pregrasp.dofs);
  const PalmApproach approach = approach_until_contact(model, pregrasp.X_OH, joints, most_travel);
  if (!approach.touches || approach.travel < least_travel) return {};
  pregrasp.X_OH = approach.X_OH;
  TestedPreGrasp tested = test_in_place(model, energy, std::move(pregrasp));
  tested.palm_moved = true;
  return tested;
}

}  // namespace

TestedPreGrasp test_pregrasp(const CollisionModel& model, const GraspEnergy& energy, PreGrasp pregrasp,
                             const PalmMove& palm) {
  if (palm.first) {
    TestedPreGrasp nearer = test_after_approach(model, energy, pregrasp, palm.most);
    return nearer.result.tests > 0 ? nearer : test_in_place(model, energy, std::move(pregrasp));
  }
  TestedPreGrasp tested = test_in_place(model, energy, std::move(pregrasp));
  if (tested.result.tests == 0 || tested.result.grasp.form_closure || palm.most <= 0.0) return tested;
  TestedPreGrasp nearer = test_after_approach(model, energy, tested.pregrasp, palm.most);
  return nearer.result.grasp.form_closure ? nearer : tested;
}

std::vector<TestedPreGrasp> test_all(const Annealer::Task& task, std::vector<PreGrasp> pregrasps,
                                     const PlanOptions& options, const PalmMove& palm) {
  std::vector<TestedPreGrasp> tested(pregrasps.size());
  parallel_for(pregrasps.size(), options.threads, [&](std::size_t i, int) {
    if (options.stop && options.stop->stop_requested()) return;
    tested[i] = test_pregrasp(task.model, task.energy, std::move(pregrasps[i]), palm);
  });
  std::erase_if(tested, [](const TestedPreGrasp& t) { return t.result.tests == 0; });
  return tested;
}

void count_outcomes(std::span<const TestedPreGrasp> tested, CandidateCounts& counts) {
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
    result.states += annealer.counts();
    if (annealer.milestones().empty()) continue;
    if (!best || annealer.milestones().back().energy < best->milestones().back().energy) best = &annealer;
  }
  if (best) result.milestones = best->milestones();
}

}  // namespace eigengrasp
