// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/geometry/mesh_motion.hpp"

namespace eigengrasp {

/// What the motion that brought a hand into a pose tells of how near its surfaces are to others there: spares
/// those who ask next most of the search, and changes nothing of what they find. Empty where nothing is
/// known.
struct HandProximity {
  std::vector<SeparationFront> object_fronts;  ///< (n_links) of the object (a) and each link (b)
  /// Distances [m] that are sure in this pose, 0 where nothing is known: of each link (n_links) from the
  /// object, from each obstacle (n_obstacles x n_links, by obstacle), and of each collision pair.
  std::vector<double> object_clearance;
  std::vector<double> obstacle_clearance;
  std::vector<double> pair_clearance;
};

}  // namespace eigengrasp
