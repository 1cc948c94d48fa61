// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// Something about a hand that a user should know.
struct HandFinding {
  enum class Severity {
    note,     ///< may be meant so
    warning,  ///< plans will be worse
    error,    ///< plans will fail or mean nothing
  };
  Severity severity = Severity::warning;
  std::string sentence;  ///< what is wrong, and how to mend it
};

/// "note", "warning" or "error".
std::string severity_name(HandFinding::Severity severity);

/// Says what is wrong with a hand, worst first: collisions with itself in its rest posture, virtual contacts
/// that are missing, off the surface or point inwards, closing speeds, limits, eigengrasps, sizes and masses,
/// open meshes. Empty for a hand without fault. Cost: seconds for large meshes.
/// @pre check_invariants holds but for the order of limits
std::vector<HandFinding> check_hand(const HandModel& hand);

}  // namespace eigengrasp
