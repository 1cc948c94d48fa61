// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <vector>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/annealer.hpp"

namespace eigengrasp::testing {

/// A state with any position and orientation in the space, and any amplitudes.
inline HandState any_state(const SearchSpace& space, RandomStream& random) {
  HandState s;
  for (Eigen::Index i = 0; i < 3; ++i)
    s.p_OA[i] = space.center_O[i] + space.half_range[i] * random.uniform(-1.0, 1.0);
  s.q_OA.coeffs() = Eigen::Vector4d(random.normal(), random.normal(), random.normal(), random.normal());
  s.q_OA.normalize();
  s.amplitudes.resize(space.postures.size());
  for (int i = 0; i < space.postures.size(); ++i)
    s.amplitudes[i] = random.uniform(space.postures[i].min, space.postures[i].max);
  return s;
}

/// A neighbour as an Annealer draws it, by scalar code.
inline HandState any_neighbor(const SearchSpace& space, const HandState& from, double temperature,
                              RandomStream& random) {
  const auto jump = [&] { return NeighborJump(temperature)(random.uniform()); };
  const auto shift = [&](double value, double most, double low, double high) {
    for (int attempt = 0; attempt < 7; ++attempt) {
      const double moved = value + most * jump();
      if (moved >= low && moved <= high) return moved;
    }
    return value;
  };
  HandState s = from;
  for (Eigen::Index i = 0; i < 3; ++i)
    s.p_OA[i] = shift(from.p_OA[i], space.max_shift, space.center_O[i] - space.half_range[i],
                      space.center_O[i] + space.half_range[i]);
  const Vec3 turn = space.max_turn * Vec3(jump(), jump(), jump());
  const double angle = turn.norm();
  if (angle > 0.0)
    s.q_OA = (from.q_OA * Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle))).normalized();
  for (int i = 0; i < space.postures.size(); ++i) {
    const Eigengrasp& e = space.postures[i];
    s.amplitudes[i] = shift(from.amplitudes[i], space.max_amplitude_jump * (e.max - e.min), e.min, e.max);
  }
  return s;
}

/// Link poses of a state, in double precision.
inline std::vector<Pose> link_poses(const HandModel& hand, const SearchSpace& space, const HandState& state) {
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joint_values(hand, hand_posture(hand, space, state)), hand_pose(hand, state),
                     X_OL);
  return X_OL;
}

/// Simulated annealing as an Annealer's of sixteen chains, but drawn and accepted by scalar code, and every
/// state that is drawn is judged and seen.
class SeenWalk {
 public:
  /// @param see is called with the batch of each step, evaluated without thresholds
  using See = std::function<void(const StateEvaluator::Batch&)>;

  SeenWalk(const SearchSpace& space, const StateEvaluator& evaluator, std::uint64_t seed)
      : space_(space), evaluator_(evaluator), random_({seed, 77}), batch_(evaluator) {}

  void anneal(const AnnealingSchedule& schedule, int steps, const See& see) {
    constexpr int n = StateEvaluator::lanes;
    std::vector<HandState> now;
    for (int c = 0; c < n; ++c) {
      now.push_back(any_state(space_, random_));
      now.back().amplitudes.setZero();
    }
    std::vector<double> energy(n, 1e8);
    for (int step = 0; step < steps; ++step) {
      const double progress = static_cast<double>(step) / steps;
      const double width = schedule.temperature(progress);
      for (int c = 0; c < n; ++c)
        batch_.set(c, any_neighbor(space_, now[static_cast<std::size_t>(c)], width, random_));
      evaluator_.evaluate(batch_);
      see(batch_);
      for (int c = 0; c < n; ++c) {
        const auto k = static_cast<std::size_t>(c);
        const double limit =
            energy[k] - schedule.acceptance_temperature(progress) * std::log(1.0 - random_.uniform());
        if (batch_.verdict(c) != StateEvaluator::Verdict::legal || batch_.energy(c) >= limit) continue;
        now[k] = batch_.state(c);
        energy[k] = batch_.energy(c);
      }
    }
  }

 private:
  const SearchSpace& space_;
  const StateEvaluator& evaluator_;
  RandomStream random_;
  StateEvaluator::Batch batch_;
};

}  // namespace eigengrasp::testing
