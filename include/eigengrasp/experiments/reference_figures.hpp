// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/model_io/paper_models.hpp"

namespace eigengrasp {

// What ours is compared with.

/// Form-closed grasps of 20 pre-grasps, mean of 5 runs: Table II of the paper (Ciocarlie and Allen, "Hand
/// posture subspaces for dexterous robotic grasping", 2009), 70,000 iterations of its annealing each.
double paper_form_closed(PaperHand hand, PaperObject object);

/// The same by GraspIt! itself (its qt5 branch, its own models and materials), measured for this comparison
/// on a two-core Xeon virtual machine: 40,000 steps from K0 = 30000, best lists of 11 to 20 states, hulls
/// corrected (closure means epsilon >= 1e-6), mean of 5 seeds for most cells.
double graspit_form_closed(PaperHand hand, PaperObject object);

/// Smallest time [s] that GraspIt! took on that machine, one core, for a state (legality and contact energy)
/// of this hand over the six objects; of the human hand, on the glass.
double graspit_state_seconds(PaperHand hand);

// Other figures of GraspIt! on that machine, one core [s].
inline constexpr double kGraspitCandidateSeconds =
    0.050;                                             ///< close, contacts, closure, epsilon; 0.03 to 0.11
inline constexpr double kGraspitRunSeconds = 20.0;     ///< 40,000 steps and the best 20; 15 to 58
inline constexpr double kQhullEpsilonSeconds = 0.017;  ///< Qhull, 8 contacts of 8 edges

}  // namespace eigengrasp
