// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <vector>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/planning/annealer.hpp"
#include "online/approach_space.hpp"

namespace eigengrasp {

/// What the operator asks of degrees of freedom. Confidence as in VariableTarget.
struct PostureWishes {
  struct Wish {
    int dof;
    double value;
    double confidence;
  };
  std::vector<Wish> wishes;

  explicit PostureWishes(const std::vector<VariableTarget>& targets = {});
  /// Added to the energy of a posture that misses the wishes; 0 where it meets them.
  double penalty(const VecX& dofs) const;
  /// The posture moved to the wishes by their confidences.
  VecX apply(VecX dofs) const;
};

/// The first stage of the online planner (sections IV-B to IV-D): sixteen chains of simulated annealing over
/// the cone ahead of the wrist, in lanes, with the energy of eq. (8). Each chain begins anew after
/// `restart_after` iterations; the chains are staggered, so that one of them is always about to end. A new
/// wrist pose is taken up between two steps. Deterministic: depends on the seed and on the step at which each
/// wrist pose came.
class ApproachSearch {
 public:
  static constexpr int n_chains = StateEvaluator::lanes;

  /// What it refers to must outlive it.
  struct Task {
    const CollisionModel& model;
    const GraspEnergy& energy;
    const StateEvaluator& evaluator;  ///< of the space's postures
    const OnlineOptions& options;
  };

  explicit ApproachSearch(const Task& task);

  /// The wrist moved on: chains go on from where they are, seen from there.
  void follow(const Pose& X_OW);
  /// A new approach: all chains begin anew.
  void begin(const Pose& X_OW);
  void aim(const std::vector<VariableTarget>& targets);

  /// Draws and evaluates one neighbour a chain. Appends what is worth a test: the best of a chain that ends,
  /// and of one that has got better since it was last asked. @pre begin was called
  void step(std::vector<PreGrasp>& candidates);

  std::int64_t iterations() const { return iterations_; }
  const ApproachSpace& space() const { return space_; }

 private:
  struct Chain {
    ApproachState state;
    double energy = 0.0;          ///< of the state
    double contact_energy = 0.0;  ///< of the state
    std::int64_t iteration = 0;   ///< since it began
    ApproachState best;           ///< since it was last asked for candidates
    double best_energy = 0.0;
    double least_asked = 0.0;  ///< lowest energy, by careful expansions, of a candidate since it began
    WeakDirections weak;
  };

  /// Of one iteration.
  struct Temperatures {
    NeighborJump jump;
    double acceptance;
  };

  void restart(Chain& chain);
  void evaluate_again();
  const Temperatures& temperatures(const Chain& chain) const {
    return temperatures_[static_cast<std::size_t>(chain.iteration)];
  }
  ApproachState neighbor(const Chain& chain);
  double energy_of(Chain& chain, const ApproachState& state, double threshold, int expansions);
  double energy_of_lane(Chain& chain, int lane, const ApproachState& state, double threshold);
  void offer(Chain& chain, std::vector<PreGrasp>& candidates);
  VecX posture(const ApproachState& state) const;

  Task task_;
  ApproachSpace space_;
  PostureWishes wishes_;
  std::vector<Temperatures> temperatures_;  ///< (restart_after)
  RandomStream random_;
  StateEvaluator::Batch batch_;
  std::array<Chain, n_chains> chains_;
  std::array<ApproachState, n_chains> proposals_;
  std::array<double, n_chains> thresholds_{};
  std::vector<ContactApproach> approaches_;
  std::vector<Pose> X_OL_;
  std::int64_t iterations_ = 0;
};

}  // namespace eigengrasp
