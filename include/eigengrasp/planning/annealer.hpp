// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <vector>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"
#include "eigengrasp/planning/pregrasp_list.hpp"

namespace eigengrasp {

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

/// Ingber's neighbour distribution: in [-1, 1], wide tails, of width T. @param u uniform in [0, 1)
double neighbor_jump(double temperature, double u);

/// The variables of the search: the approach frame of the hand (its approach point, orientation of the base)
/// in the object frame, within a box about the object, and amplitudes within their ranges.
struct SearchSpace {
  EigengraspSpace postures;
  Vec3 center_O = Vec3::Zero();      ///< of the box of approach points [m]
  Vec3 half_range = Vec3::Zero();    ///< [m]
  double max_shift = 0.15;           ///< largest jump of a coordinate [m]
  double max_turn = 1.5707963;       ///< largest jump of a component of the rotation vector [rad]
  double max_amplitude_jump = 0.25;  ///< largest jump of an amplitude, share of its range

  SearchSpace(const Scene& scene, int n_amplitudes);
};

/// One chain of simulated annealing (section III-A). Holds its own random stream and scratch memory: chains
/// run in any order, on any thread.
class AnnealingChain {
 public:
  AnnealingChain(const CollisionModel& model, const GraspEnergy& energy, const SearchSpace& space,
                 const AnnealingSchedule& schedule, PreGraspList list, RandomStream random, int chain);

  /// Draws and evaluates one state, and moves there if it is legal and accepted. @param progress in [0, 1]
  void step(double progress);

  /// Back to a new random start; the list of the best stays.
  void restart();

  std::int64_t iterations() const { return counts_.evaluated; }
  const StateCounts& counts() const { return counts_; }
  const PreGraspList& best() const { return list_; }
  /// Each state that was better than all before it.
  const std::vector<SearchMilestone>& milestones() const { return milestones_; }

 private:
  struct State {
    Vec3 p_OA = Vec3::Zero();
    Eigen::Quaterniond q_OA = Eigen::Quaterniond::Identity();
    VecX amplitudes;
  };

  State random_state();
  State neighbor(const State& state, double temperature);
  Pose hand_pose(const State& state) const;
  Legality place(const State& state);
  void remember(const State& state, double energy);

  const CollisionModel& model_;
  const GraspEnergy& energy_function_;
  const SearchSpace& space_;
  AnnealingSchedule schedule_;
  PreGraspList list_;
  RandomStream random_;
  int chain_;
  State state_;
  double energy_ = 1e8;  ///< of the start: the first legal neighbour is taken
  double best_energy_ = 1e8;
  StateCounts counts_;
  std::vector<SearchMilestone> milestones_;
  VecX dofs_;
  VecX joints_;
  std::vector<Pose> X_OL_;
  std::vector<ContactApproach> approaches_;
};

}  // namespace eigengrasp
