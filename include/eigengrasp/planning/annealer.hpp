// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"
#include "eigengrasp/planning/pregrasp_list.hpp"
#include "eigengrasp/planning/state_evaluator.hpp"

namespace eigengrasp {

class SearchAreas;

/// Ingber's very fast annealing (1989): T(k) = T0 exp(-c k^(1/D)), with GraspIt!'s numbers, where a search
/// walks from step first_k to last_k; it serves both as width of the neighbourhood and, over error_scale, as
/// temperature of acceptance [energy units].
struct AnnealingSchedule {
  double initial_temperature = 1e6;
  double decay = 7.0;
  double dimensions = 8.0;
  double first_k = 30000.0;
  double last_k = 70000.0;
  double error_scale = 1e-6;

  /// @param progress of the search in [0, 1]
  double temperature(double progress) const;
  double acceptance_temperature(double progress) const { return temperature(progress) / error_scale; }
};

/// Ingber's neighbour distribution: in [-1, 1], wide tails, of width T.
class NeighborJump {
 public:
  explicit NeighborJump(double temperature)
      : temperature_(temperature), log_range_(std::log1p(1.0 / temperature)) {}
  /// @param u uniform in [0, 1)
  double operator()(double u) const {
    const double y = temperature_ * std::expm1(log_range_ * std::abs(2.0 * u - 1.0));
    return u < 0.5 ? -y : y;
  }

 private:
  double temperature_;
  double log_range_;
};

/// Ranges and largest jumps of the variables of a HandState: the approach point within a box about the
/// object, any orientation, amplitudes within their ranges.
struct SearchSpace {
  EigengraspSpace postures;
  Vec3 center_O = Vec3::Zero();      ///< of the box of approach points [m]
  Vec3 half_range = Vec3::Zero();    ///< [m]
  double max_shift = 0.15;           ///< largest jump of a coordinate [m]
  double max_turn = 1.5707963;       ///< largest jump of a component of the rotation vector [rad]
  double max_amplitude_jump = 0.25;  ///< largest jump of an amplitude, share of its range

  SearchSpace(const Scene& scene, int n_amplitudes);
};

/// Pose of the hand base in O of a state.
Pose hand_pose(const HandModel& hand, const HandState& state);
/// Posture (n_dof) of a state, inside the limits.
VecX hand_posture(const HandModel& hand, const SearchSpace& space, const HandState& state);

/// Simulated annealing (section III-A) in sixteen lanes: one chain, or sixteen side by side. A lone chain
/// draws sixteen neighbours of its state at once and takes the first that is accepted, which is the same walk
/// as one draw after the other; draws behind the accepted one are thrown away and do not count. Holds its own
/// random streams and memory: annealers run in any order, on any thread.
///
/// Tempered, the sixteen chains stand on a ladder of temperatures, from the schedule's last to its first;
/// after every other step neighbours trade theirs by the Metropolis rule. Progress has no meaning then.
class Annealer {
 public:
  /// What annealers share; what it refers to must outlive them.
  struct Task {
    const CollisionModel& model;
    const GraspEnergy& energy;
    const SearchSpace& space;
    const StateEvaluator& evaluator;
    AnnealingSchedule schedule;
    std::uint64_t seed;
    bool judge_all = false;                ///< see PlanOptions
    bool tempered = false;                 ///< parallel tempering of sixteen chains instead of cooling
    const SearchAreas* avoided = nullptr;  ///< no chain moves into these; none: chains go anywhere
  };

  /// @param number of the annealer: with the seed the key of its random streams
  /// @param n_chains 1 or 16; tempered: 16
  /// @param list that the best distinct states are added to
  Annealer(const Task& task, std::uint64_t number, int n_chains, PreGraspList list);
  ~Annealer();
  Annealer(Annealer&&) noexcept;

  /// Draws and evaluates sixteen states; every chain moves to its first that is legal and accepted.
  /// @param progress in [0, 1]  @param most states that may be counted
  void step(double progress, std::int64_t most);

  /// All chains back to new random starts, and to their first temperatures, chain 0 to the coldest; the list
  /// of the best stays.
  void restart();
  /// One chain to a given start.
  void restart(int chain, const HandState& state);

  const StateCounts& counts() const { return counts_; }
  std::int64_t iterations() const { return counts_.evaluated; }
  /// The best distinct states since the last forget().
  const PreGraspList& best();
  /// Empties the list of the best.
  void forget();
  /// The lowest energy so far; 1e8 where no state was legal.
  double best_energy() const { return best_energy_; }
  /// Each state that was better than all before it.
  const std::vector<SearchMilestone>& milestones() const { return milestones_; }

 private:
  struct Lanes;

  HandState random_state();
  void set_temperatures(double progress);
  void temper();
  void judge_in_full();
  void count(StateEvaluator::Verdict verdict);
  void remember(int lane, int chain);
  void settle(int chain);
  PreGrasp pregrasp(const HandState& state, double energy, int chain, std::int64_t iteration) const;

  Task task_;
  int n_chains_;
  int number_;
  PreGraspList list_;
  RandomStream random_;
  std::unique_ptr<Lanes> lanes_;
  double best_energy_ = 1e8;
  StateCounts counts_;
  std::vector<SearchMilestone> milestones_;
};

}  // namespace eigengrasp
