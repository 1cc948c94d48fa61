// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/hand_assembly.hpp"

#include <algorithm>
#include <limits>

namespace eigengrasp {

int set_dof_limits(HandModel& hand) {
  for (HandDof& dof : hand.dofs) {
    dof.min = -std::numeric_limits<double>::infinity();
    dof.max = std::numeric_limits<double>::infinity();
  }
  for (const HandJoint& joint : hand.joints) {
    if (joint.dof < 0) continue;
    HandDof& dof = hand.dofs[static_cast<std::size_t>(joint.dof)];
    const double a = (joint.min - joint.offset) / joint.ratio;
    const double b = (joint.max - joint.offset) / joint.ratio;
    dof.min = std::max(dof.min, std::min(a, b));
    dof.max = std::min(dof.max, std::max(a, b));
  }
  for (int d = 0; d < hand.n_dof(); ++d) {
    HandDof& dof = hand.dofs[static_cast<std::size_t>(d)];
    if (!std::isfinite(dof.min) || !std::isfinite(dof.max)) return d;
    if (dof.min > dof.max + 1e-9) return d;
    dof.max = std::max(dof.min, dof.max);
  }
  return -1;
}

void clamp_rest(HandModel& hand) {
  for (HandDof& dof : hand.dofs) dof.rest = std::clamp(dof.rest, dof.min, dof.max);
}

EigengraspSpace all_postures(const HandModel& hand) {
  return EigengraspSpace::identity(hand.rest_posture(), hand.dof_min(), hand.dof_max(), hand.dof_names());
}

}  // namespace eigengrasp
