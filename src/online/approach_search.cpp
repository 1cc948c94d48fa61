// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "online/approach_search.hpp"

#include <algorithm>
#include <cmath>

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

constexpr double no_energy = 1e8;  // of a start: the first legal neighbour is taken
/// States whose contact energy is higher by this than the chain's are not asked for eq. (8).
constexpr double wrench_margin = 10.0;
/// Of the polytope for eq. (8): for a neighbour, where the chain's weak directions tell most; for the state
/// of a chain from time to time; for a candidate.
constexpr int few_expansions = 2;
constexpr int careful_expansions = 8;
constexpr int all_expansions = 0;
/// How often a chain is asked for a candidate [iterations].
constexpr std::int64_t ask_every = 100;
/// A candidate's energy, by careful expansions, must be lower than the last one's of its chain by this.
constexpr double worth_asking = 1.0;
/// Contact energy above which closing is hopeless: 30 mm, or less with the fingers turned away.
constexpr double highest_candidate = 30.0;
constexpr double penalty_per_radian = 50.0;  // of a posture that misses a wish of full confidence

/// GraspIt!'s numbers for its online planner.
AnnealingSchedule jump_schedule(std::int64_t restart_after) {
  return {10.0, 0.24, 2.0, 100.0, 100.0 + static_cast<double>(restart_after), 1.0};
}
AnnealingSchedule acceptance_schedule(std::int64_t restart_after) {
  return {10.0, 0.54, 3.0, 100.0, 100.0 + static_cast<double>(restart_after), 0.01};
}

}  // namespace

PostureWishes::PostureWishes(const std::vector<VariableTarget>& targets) {
  for (const VariableTarget& t : targets)
    if (t.variable == VariableTarget::Variable::dof) wishes.push_back({t.index, t.value, t.confidence});
}

double PostureWishes::penalty(const VecX& dofs) const {
  double sum = 0.0;
  for (const Wish& w : wishes) sum += w.confidence * std::abs(dofs[w.dof] - w.value);
  return penalty_per_radian * sum;
}

VecX PostureWishes::apply(VecX dofs) const {
  for (const Wish& w : wishes) dofs[w.dof] += w.confidence * (w.value - dofs[w.dof]);
  return dofs;
}

ApproachSearch::ApproachSearch(const Task& task)
    : task_(task),
      space_(task.model.scene(), task.options),
      random_({task.options.seed, 0}),
      batch_(task.evaluator) {
  const std::int64_t n = task.options.restart_after;
  for (std::int64_t i = 0; i < n; ++i) {
    const double progress = static_cast<double>(i) / static_cast<double>(n);
    temperatures_.push_back({NeighborJump(jump_schedule(n).temperature(progress)),
                             acceptance_schedule(n).acceptance_temperature(progress)});
  }
  batch_.keep_approaches();
  begin(Pose::Identity());
}

void ApproachSearch::begin(const Pose& X_OW) {
  space_.follow(X_OW);
  for (int c = 0; c < n_chains; ++c) {
    Chain& chain = chains_[static_cast<std::size_t>(c)];
    restart(chain);
    chain.iteration = c * task_.options.restart_after / n_chains;
  }
}

void ApproachSearch::follow(const Pose& X_OW) {
  const Pose before = space_.wrist();
  space_.follow(X_OW);
  for (Chain& chain : chains_) {
    space_.move_on(chain.state, before);
    space_.move_on(chain.best, before);
  }
  evaluate_again();
}

void ApproachSearch::aim(const std::vector<VariableTarget>& targets) {
  space_.aim(targets);
  wishes_ = PostureWishes(targets);
  for (Chain& chain : chains_) {
    space_.clamp(chain.state);
    chain.best_energy = chain.least_asked = no_energy;
  }
  evaluate_again();
}

void ApproachSearch::restart(Chain& chain) {
  chain.state.amplitudes.resize(task_.options.amplitudes);
  for (int i = 0; i < space_.size(); ++i) {
    const ApproachSpace::Range& r = space_.ranges()[static_cast<std::size_t>(i)];
    space_.set_variable(chain.state, i, random_.uniform(r.low, r.high));
  }
  space_.clamp(chain.state);
  chain.best = chain.state;
  chain.energy = chain.contact_energy = chain.best_energy = chain.least_asked = no_energy;
  chain.iteration = 0;
}

VecX ApproachSearch::posture(const ApproachState& state) const {
  return clamp_posture(*task_.model.scene().hand, space_.postures().embed(state.amplitudes));
}

/// What the states of the chains are worth from where the wrist is now.
void ApproachSearch::evaluate_again() {
  for (int c = 0; c < n_chains; ++c) {
    batch_.set(c, space_.hand_state(chains_[static_cast<std::size_t>(c)].state));
    batch_.set_threshold(c, std::numeric_limits<double>::infinity());
  }
  task_.evaluator.evaluate(batch_);
  for (int c = 0; c < n_chains; ++c) {
    Chain& chain = chains_[static_cast<std::size_t>(c)];
    chain.energy = chain.contact_energy = no_energy;
    if (batch_.verdict(c) == StateEvaluator::Verdict::legal) {
      chain.contact_energy = batch_.energy(c);
      chain.energy = energy_of(chain, chain.state, no_energy, careful_expansions);
    }
    chain.best = chain.state;
    chain.best_energy = chain.energy;
  }
}

ApproachState ApproachSearch::neighbor(const Chain& chain) {
  const NeighborJump& jump = temperatures(chain).jump;
  ApproachState s = chain.state;
  for (int i = 0; i < space_.size(); ++i) {
    const double longest = space_.ranges()[static_cast<std::size_t>(i)].jump;
    space_.set_variable(s, i, space_.variable(s, i) + longest * jump(random_.uniform()));
  }
  space_.clamp(s);
  return s;
}

/// Energy of a legal state: eq. (8) where its contacts enclose the origin, and what the operator's wishes
/// add.
double ApproachSearch::energy_of(Chain& chain, const ApproachState& state, double threshold, int expansions) {
  const HandModel& hand = *task_.model.scene().hand;
  const VecX dofs = posture(state);
  const double penalty = wishes_.penalty(dofs);
  compute_link_poses(hand, joint_values(hand, dofs), hand_pose(hand, space_.hand_state(state)), X_OL_);
  task_.energy.approach(X_OL_, DistanceSource::gradients, approaches_);
  return penalty + task_.energy.wrench_energy(approaches_, threshold - penalty, chain.weak, expansions);
}

/// The same of a state that was just evaluated in a lane.
double ApproachSearch::energy_of_lane(Chain& chain, int lane, const ApproachState& state, double threshold) {
  const double penalty = wishes_.wishes.empty() ? 0.0 : wishes_.penalty(posture(state));
  batch_.approaches(lane, approaches_);
  return penalty + task_.energy.wrench_energy(approaches_, threshold - penalty, chain.weak, few_expansions);
}

void ApproachSearch::step(std::vector<PreGrasp>& candidates) {
  for (int c = 0; c < n_chains; ++c) {
    const auto i = static_cast<std::size_t>(c);
    Chain& chain = chains_[i];
    proposals_[i] = neighbor(chain);
    thresholds_[i] = chain.energy - temperatures(chain).acceptance * std::log(1.0 - random_.uniform());
    batch_.set(c, space_.hand_state(proposals_[i]));
    batch_.set_threshold(c, std::max(thresholds_[i], chain.contact_energy + wrench_margin));
  }
  task_.evaluator.evaluate(batch_);
  for (int c = 0; c < n_chains; ++c) {
    const auto i = static_cast<std::size_t>(c);
    Chain& chain = chains_[i];
    ++chain.iteration;
    ++iterations_;
    if (batch_.verdict(c) == StateEvaluator::Verdict::legal) {
      const double energy = energy_of_lane(chain, c, proposals_[i], thresholds_[i]);
      if (energy < thresholds_[i]) {
        chain.state = proposals_[i];
        chain.energy = energy;
        chain.contact_energy = batch_.energy(c);
      }
      if (chain.energy < chain.best_energy) {
        chain.best = chain.state;
        chain.best_energy = chain.energy;
      }
    }
    const bool ends = chain.iteration >= task_.options.restart_after;
    if (ends || chain.iteration % ask_every == 0) offer(chain, candidates);
    if (ends) restart(chain);
  }
}

/// The best state since the last time, where it is worth a test. Its energy is worked out in full.
void ApproachSearch::offer(Chain& chain, std::vector<PreGrasp>& candidates) {
  // What few expansions leave open flatters; asked again, most are no better than the chain's last offer.
  const double limit = std::min(highest_candidate, chain.least_asked - worth_asking);
  const double careful =
      chain.best_energy < limit ? energy_of(chain, chain.best, no_energy, careful_expansions) : no_energy;
  if (careful < limit) {
    const HandModel& hand = *task_.model.scene().hand;
    PreGrasp p;
    p.X_OH = hand_pose(hand, space_.hand_state(chain.best));
    p.amplitudes = chain.best.amplitudes;
    p.dofs = clamp_posture(hand, wishes_.apply(posture(chain.best)));
    p.energy = energy_of(chain, chain.best, no_energy, all_expansions);
    p.iteration = iterations_;
    chain.least_asked = careful;
    if (p.energy < highest_candidate) candidates.push_back(std::move(p));
  }
  if (chain.energy < no_energy) chain.energy = energy_of(chain, chain.state, no_energy, careful_expansions);
  chain.best = chain.state;
  chain.best_energy = chain.energy;
}

}  // namespace eigengrasp
