// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/planning/annealer.hpp"
#include "eigengrasp/planning/pregrasp_list.hpp"

namespace eigengrasp {

/// Neighbourhoods of pre-grasps, in position, rotation and posture, that a search keeps away from because
/// others work there (section V-B). Asked by any number of threads while nothing is added.
class SearchAreas {
 public:
  /// @param size a state that is not distinct from a pre-grasp is in its neighbourhood. The hand and the
  /// space must outlive the areas.
  SearchAreas(const HandModel& hand, const SearchSpace& space, const Distinctness& size)
      : hand_(hand), space_(space), size_(size) {}

  void add(const PreGrasp& center);
  bool holds(const PreGrasp& pregrasp) const;
  /// Cost: 0.1 us for 50 areas that are elsewhere.
  bool holds(const HandState& state) const;

 private:
  const HandModel& hand_;
  const SearchSpace& space_;
  Distinctness size_;
  std::vector<PreGrasp> centers_;
  std::vector<Vec3> places_;  ///< of their approach points in O
};

}  // namespace eigengrasp
