// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/child_search.hpp"

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "planning/kernel/program.hpp"

namespace eigengrasp {

namespace {

constexpr double palm_approach = 0.030;  // [m] see test_all
constexpr std::int64_t n_states = 480;   // of a local search
constexpr double half_range = 0.015;     // of the approach point about the pre-grasp's [m]
constexpr double fine_shift = 0.010;     // largest jump [m]
constexpr double fine_turn = 0.25;       // [rad]
constexpr double fine_amplitude = 0.06;  // share of the range
constexpr double fine_distinct = 0.25;   // of what makes two pre-grasps distinct
constexpr std::size_t list_size = 8;     // states that are asked for eq. (8)

SearchSpace space_about(const PreGrasp& pregrasp, const HandModel& hand, const SearchSpace& whole) {
  SearchSpace space = whole;
  space.center_O = pregrasp.X_OH * hand.approach_point_H;
  space.half_range = Vec3::Constant(half_range);
  space.max_shift = fine_shift;
  space.max_turn = fine_turn;
  space.max_amplitude_jump = fine_amplitude;
  return space;
}

Distinctness fine_distinctness(const HandModel& hand) {
  Distinctness d = distinctness_of(hand);
  d.position *= fine_distinct;
  d.rotation *= fine_distinct;
  d.posture *= fine_distinct;
  return d;
}

}  // namespace

double compute_wrench_energy(const CollisionModel& model, const GraspEnergy& energy,
                             const PreGrasp& pregrasp) {
  const HandModel& hand = *model.scene().hand;
  std::vector<Pose> X_OL;
  std::vector<ContactApproach> approaches;
  compute_link_poses(hand, joint_values(hand, pregrasp.dofs), pregrasp.X_OH, X_OL);
  energy.approach(X_OL, DistanceSource::field, approaches);
  return energy.wrench_energy(approaches);
}

/// The best state by eq. (8); none where no neighbour is legal.
std::optional<PreGrasp> ChildSearch::search_about(const PreGrasp& pregrasp, std::uint64_t number, int worker,
                                                  StateCounts& counts) const {
  const HandModel& hand = *parent_.model.scene().hand;
  const SearchSpace space = space_about(pregrasp, hand, parent_.space);
  const Annealer::Task task{parent_.model,     parent_.energy,   space,
                            parent_.evaluator, parent_.schedule, parent_.seed};
  Annealer annealer(task, number, kernel::n_lanes, PreGraspList(list_size, fine_distinctness(hand)));
  const HandState start{space.center_O, orientation(pregrasp.X_OH), pregrasp.amplitudes};
  for (int chain = 0; chain < kernel::n_lanes; ++chain) annealer.restart(chain, start);
  budget_.anneal(annealer, n_states, worker);
  counts = annealer.counts();
  std::optional<PreGrasp> best;
  for (PreGrasp p : annealer.best().items()) {
    p.energy = compute_wrench_energy(parent_.model, parent_.energy, p);
    if (!best || p.energy < best->energy) best = std::move(p);
  }
  return best;
}

ChildResult ChildSearch::refine(const PreGrasp& pregrasp, std::uint64_t number, bool anneals,
                                int worker) const {
  ChildResult result;
  result.tested = test_pregrasp(parent_.model, parent_.energy, pregrasp, {palm_approach});
  result.tests = result.tested.result.tests;
  if (result.tested.result.grasp.form_closure || !anneals || budget_.ended()) return result;
  const std::optional<PreGrasp> better = search_about(pregrasp, number, worker, result.states);
  if (!better) return result;
  TestedPreGrasp again = test_pregrasp(parent_.model, parent_.energy, *better, {palm_approach});
  result.tests += again.result.tests;
  if (again.result.grasp.form_closure || result.tested.result.tests == 0) result.tested = std::move(again);
  return result;
}

}  // namespace eigengrasp
