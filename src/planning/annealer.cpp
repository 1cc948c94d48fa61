// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/annealer.hpp"

#include <algorithm>
#include <cmath>

#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

double AnnealingSchedule::temperature(double progress) const {
  const double k = first_k + progress * (last_k - first_k);
  return initial_temperature * std::exp(-decay * std::pow(k, 1.0 / dimensions));
}

double neighbor_jump(double temperature, double u) {
  const double y = temperature * (std::pow(1.0 + 1.0 / temperature, std::abs(2.0 * u - 1.0)) - 1.0);
  return u < 0.5 ? -y : y;
}

SearchSpace::SearchSpace(const Scene& scene, int n_amplitudes)
    : postures(
          scene.hand->eigengrasps.with_size(n_amplitudes, scene.hand->dof_min(), scene.hand->dof_max())) {
  const Box box = bounding_box(scene.object->mesh);
  center_O = box.center();
  // The approach point lies in front of the palm: farther than this from the object no contact is near.
  half_range = 0.5 * box.size() + Vec3::Constant(0.5 * hand_reach(*scene.hand));
}

AnnealingChain::AnnealingChain(const CollisionModel& model, const GraspEnergy& energy,
                               const SearchSpace& space, const AnnealingSchedule& schedule, PreGraspList list,
                               RandomStream random, int chain)
    : model_(model),
      energy_function_(energy),
      space_(space),
      schedule_(schedule),
      list_(std::move(list)),
      random_(random),
      chain_(chain) {
  restart();
}

void AnnealingChain::restart() {
  state_ = random_state();
  energy_ = 1e8;
}

AnnealingChain::State AnnealingChain::random_state() {
  State s;
  for (Eigen::Index i = 0; i < 3; ++i)
    s.p_OA[i] = space_.center_O[i] + space_.half_range[i] * random_.uniform(-1.0, 1.0);
  s.q_OA.coeffs() = Eigen::Vector4d(random_.normal(), random_.normal(), random_.normal(), random_.normal());
  s.q_OA.normalize();
  s.amplitudes = VecX::Zero(space_.postures.size());
  return s;
}

// Every variable jumps, each for itself; a jump beyond a range is drawn again.
AnnealingChain::State AnnealingChain::neighbor(const State& state, double temperature) {
  const auto jump = [&](double value, double max_jump, double low, double high) {
    for (int attempt = 0; attempt < 100; ++attempt) {
      const double moved = value + max_jump * neighbor_jump(temperature, random_.uniform());
      if (moved >= low && moved <= high) return moved;
    }
    return std::clamp(value, low, high);
  };
  State s = state;
  for (Eigen::Index i = 0; i < 3; ++i)
    s.p_OA[i] = jump(state.p_OA[i], space_.max_shift, space_.center_O[i] - space_.half_range[i],
                     space_.center_O[i] + space_.half_range[i]);
  Vec3 turn;
  for (Eigen::Index i = 0; i < 3; ++i)
    turn[i] = space_.max_turn * neighbor_jump(temperature, random_.uniform());
  const double angle = turn.norm();
  if (angle > 0.0) s.q_OA = (s.q_OA * Eigen::AngleAxisd(angle, turn / angle)).normalized();
  for (Eigen::Index i = 0; i < s.amplitudes.size(); ++i) {
    const Eigengrasp& e = space_.postures[static_cast<int>(i)];
    s.amplitudes[i] = jump(state.amplitudes[i], space_.max_amplitude_jump * (e.max - e.min), e.min, e.max);
  }
  return s;
}

Pose AnnealingChain::hand_pose(const State& state) const {
  Pose X_OA = make_pose(state.q_OA, state.p_OA);
  return X_OA * Eigen::Translation3d(-model_.scene().hand->approach_point_H);
}

/// p = p_m + sum a_i e_i, then forward kinematics, then: is the hand free?
Legality AnnealingChain::place(const State& state) {
  const HandModel& hand = *model_.scene().hand;
  dofs_ = clamp_posture(hand, space_.postures.embed(state.amplitudes));
  joints_ = joint_values(hand, dofs_);
  compute_link_poses(hand, joints_, hand_pose(state), X_OL_);
  return model_.check_fast(X_OL_);
}

void AnnealingChain::step(double progress) {
  const State next = neighbor(state_, schedule_.temperature(progress));
  ++counts_.evaluated;
  switch (place(next)) {
    case Legality::hits_object:
      ++counts_.hit_object;
      return;
    case Legality::hits_itself:
      ++counts_.hit_itself;
      return;
    case Legality::hits_obstacle:
      ++counts_.hit_obstacle;
      return;
    case Legality::legal:
      ++counts_.legal;
      break;
  }
  const double energy = energy_function_.evaluate(X_OL_, DistanceSource::field, approaches_);
  const double rise = energy - energy_;
  if (rise >= 0.0 && random_.uniform() >= std::exp(-rise / schedule_.acceptance_temperature(progress)))
    return;
  state_ = next;
  energy_ = energy;
  remember(next, energy);
}

void AnnealingChain::remember(const State& state, double energy) {
  const bool record = energy < best_energy_;
  if (!record && !list_.admits(energy)) return;
  const Pose X_OH = hand_pose(state);
  if (record) {
    best_energy_ = energy;
    milestones_.push_back({counts_.evaluated, energy, X_OH, dofs_});
  }
  if (list_.admits(energy)) list_.add({X_OH, state.amplitudes, dofs_, energy, chain_, counts_.evaluated});
}

}  // namespace eigengrasp
