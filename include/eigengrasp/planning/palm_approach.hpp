// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/grasp/collision_model.hpp"

namespace eigengrasp {

/// Where a hand that moves along its approach direction stops.
struct PalmApproach {
  Pose X_OH = Pose::Identity();  ///< there
  double travel = 0.0;           ///< [m] from the start
  bool touches = false;          ///< stopped by the object or an obstacle, not by the end of the travel
};

/// Moves the hand along its approach direction, fingers held as they are, until that brings a link within
/// contact_gap of the object or of an obstacle, or the travel ends. By conservative advancement on exact
/// meshes: nothing is passed through, and the hand does not penetrate where it stops. What slides past does
/// not stop it; a hand that penetrates at the start stays there. Contacts of the hand with itself do not
/// change.
/// @param joints (n_joints) @param max_travel [m], >= 0 @param contact_gap [m], > 0
/// Cost: 0.1-0.6 ms for a hand of 16 links of 600 triangles each.
PalmApproach approach_until_contact(const CollisionModel& model, const Pose& X_OH, const VecX& joints,
                                    double max_travel, double contact_gap = 0.0001);

}  // namespace eigengrasp
