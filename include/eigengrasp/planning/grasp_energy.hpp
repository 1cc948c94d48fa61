// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// Where distances of virtual contacts come from.
enum class DistanceSource {
  field,      ///< the object's distance field, and nearest points where it does not know the direction
  gradients,  ///< the field alone: near its medial axis the direction is that of its gradient. Fastest
  exact,      ///< nearest points on the mesh
};

/// One virtual contact of a posed hand and the object.
struct ContactApproach {
  double distance = 0.0;  ///< |o_i| [m]
  double cosine = 0.0;    ///< n_i . o_i / |o_i|
  Vec3 p_OC = Vec3::Zero();
  Vec3 n_OC = Vec3::UnitZ();  ///< outwards from the hand
  /// delta_i of eq. (6); alpha [m].
  double delta(double alpha) const { return distance / alpha + (1.0 - cosine); }
};

/// Directions in which the wrench spaces of a chain's states reached least far. States nearby are mostly weak
/// in the same directions, so that one of them tells that a state is worse, without its epsilon.
class WeakDirections {
 public:
  void add(const Vec6& u) {
    directions_[next_] = u;
    next_ = (next_ + 1) % directions_.size();
    size_ = std::min(size_ + 1, directions_.size());
  }
  std::span<const Vec6> all() const { return {directions_.data(), size_}; }

 private:
  std::array<Vec6, 16> directions_;
  std::size_t size_ = 0;
  std::size_t next_ = 0;
};

/// The quality functions of sections III-B and IV-C, as energies to minimise. Immutable, shared; scratch is
/// the caller's.
class GraspEnergy {
 public:
  GraspEnergy(const CollisionModel& model, const PlanOptions& options);

  /// Approaches of all virtual contacts, in their order. Cost: 0.05 us each from the field, 1-2 us exactly.
  void approach(const std::vector<Pose>& X_OL, DistanceSource source,
                std::vector<ContactApproach>& out) const;

  /// Mean over the virtual contacts of 1000 alpha delta_i: for alpha = 50 mm the distance in mm + 50 (1 - n .
  /// o / |o|).
  double contact_energy(const std::vector<ContactApproach>& approaches) const;

  /// Q of eq. (7): sum of 1 - delta_i.
  double paper_quality(const std::vector<ContactApproach>& approaches) const;

  /// Eq. (8): where the wrenches of the virtual contacts, each scaled by 1 - delta_i (those below 0 left
  /// out), enclose the origin, -100 epsilon (all six dimensions, L1); elsewhere the contact energy, so that
  /// the search finds its way there.
  double wrench_energy(const std::vector<ContactApproach>& approaches) const;

  /// The same for a search that wants it only where it is below a threshold: else anything from there up is
  /// returned, at a hundredth of the cost where the weak directions tell. @param weak of the chain; takes up
  /// what limits this state @param most_expansions see RoughEpsilon: the
  /// energy may come out too low by what they leave open
  double wrench_energy(const std::vector<ContactApproach>& approaches, double threshold, WeakDirections& weak,
                       int most_expansions) const;

  /// The energy that the options name.
  double evaluate(const std::vector<Pose>& X_OL, DistanceSource source,
                  std::vector<ContactApproach>& scratch) const;

  EnergyKind kind() const { return kind_; }

  /// Options of the wrench space of final grasps: about the centre of mass, torques scaled by the object's
  /// max_radius.
  const WrenchSpaceOptions& wrench_space() const { return wrench_space_; }

 private:
  const CollisionModel& model_;
  EnergyKind kind_;
  double alpha_;
  WrenchSpaceOptions wrench_space_;
  std::vector<double> friction_;  ///< one a virtual contact
};

}  // namespace eigengrasp
