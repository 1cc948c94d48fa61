// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// A legal state of the search.
struct PreGrasp {
  Pose X_OH = Pose::Identity();
  VecX amplitudes;  ///< (size of the searched space)
  VecX dofs;        ///< (n_dof), inside the limits
  double energy = 0.0;
  int chain = 0;
  std::int64_t iteration = 0;  ///< of its chain
};

/// How far apart two pre-grasps must be to count as two.
struct Distinctness {
  double position = 0.015;  ///< of the approach point [m]
  double rotation = 0.35;   ///< [rad]
  double posture = 0.5;     ///< Euclidean, of the degrees of freedom [rad]
  Vec3 approach_point_H = Vec3::Zero();

  /// Root of the summed squares of the three differences, each over its length above: below 1 the two are
  /// one.
  double between(const PreGrasp& a, const PreGrasp& b) const;
};

/// The best distinct pre-grasps seen, by rising energy. Of two that are not distinct the better stays.
class PreGraspList {
 public:
  PreGraspList(std::size_t capacity, const Distinctness& distinctness)
      : capacity_(capacity), distinct_(distinctness) {}

  /// Whether an energy is low enough to enter; cheap, ask before building a candidate.
  bool admits(double energy) const { return items_.size() < capacity_ || energy < items_.back().energy; }
  /// True where the candidate was taken in.
  bool add(PreGrasp candidate);
  /// Takes the one of lowest energy out; none where the list is empty.
  std::optional<PreGrasp> take_best();
  const std::vector<PreGrasp>& items() const { return items_; }
  void clear();
  const Distinctness& distinctness() const { return distinct_; }

 private:
  /// Whether the two are not distinct. @param place of the first one's approach point in O
  bool same(const PreGrasp& p, const Vec3& place, std::size_t item) const;

  std::size_t capacity_;
  Distinctness distinct_;
  std::vector<PreGrasp> items_;
  std::vector<Vec3> places_;  ///< of their approach points in O
};

}  // namespace eigengrasp
