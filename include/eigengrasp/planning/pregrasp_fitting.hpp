// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/grasp/collision_model.hpp"

namespace eigengrasp {

struct FittingOptions {
  double back_step = 0.0025;    ///< of a step backwards [m]
  double most_back = 0.400;     ///< backwards in all, after which it is given up [m]
  double open_step = 1.0 / 32;  ///< of a step of opening, over the range of the degree of freedom
  double contact_gap = 0.0001;  ///< where the forward motion ends [m]
};

/// A pre-grasp of another object, fitted to this one.
struct FittedPreGrasp {
  bool free = false;  ///< palm and fingers could be brought away from the object; else the rest is of where
                      ///< it was given up
  Pose X_OH_free = Pose::Identity();  ///< hand base before it moves forwards
  Pose X_OH = Pose::Identity();       ///< hand base at the end
  VecX dofs;                          ///< (n_dof)
  double backwards = 0.0;             ///< travel to X_OH_free [m]
  double forwards = 0.0;              ///< travel from there to X_OH [m]
  bool touches = false;               ///< the forward motion ended in contact; else it was not made
};

/// The motions of Algorithm 1 (section VI-A of the paper): the hand moves backwards, against its approach
/// direction, until the palm is free of the object and of obstacles; each finger opens until it is free, all
/// its degrees of freedom at once, against their closing directions; the hand moves forwards until it
/// touches. Where a finger is not free even when it is open, which the algorithm leaves out, the hand moves
/// on backwards. A hand that would miss the object on its way forwards stays where it was free. Palm and
/// fingers: finger_roots. @param dofs (n_dof), clamped to the limits. Cost: 1-3 ms.
FittedPreGrasp fit_pregrasp(const CollisionModel& model, const Pose& X_OH, const VecX& dofs,
                            const FittingOptions& options = {});

}  // namespace eigengrasp
