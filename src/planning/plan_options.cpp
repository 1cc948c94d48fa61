// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

std::vector<std::string> PlanOptions::validate(const HandModel& hand) const {
  std::vector<std::string> violations;
  const auto require = [&](bool sound, std::string sentence) {
    if (!sound) violations.push_back(std::move(sentence));
  };
  require(iterations >= 0, fmt::format("iterations is {}, expected 0 or more", iterations));
  require(time_limit >= 0.0, fmt::format("time limit is {} s, expected 0 or more", time_limit));
  require(iterations > 0 || time_limit > 0.0,
          "neither iterations nor a time limit is given: the search would not end");
  require(grasps >= 1 && grasps <= 100000, fmt::format("grasps is {}, expected 1 to 100000", grasps));
  require(threads >= 0 && threads <= 4096, fmt::format("threads is {}, expected 0 (all) to 4096", threads));
  require(chains >= 1 && chains <= 4096, fmt::format("chains is {}, expected 1 to 4096", chains));
  require(amplitudes >= 0 && amplitudes <= hand.n_dof(),
          fmt::format("eigengrasps is {}, expected 0 to {}, the degrees of freedom of {}", amplitudes,
                      hand.n_dof(), hand.name));
  require(alpha > 0.0, fmt::format("alpha is {} m, expected more than 0", alpha));
  require(cone_edges >= 3 && cone_edges <= 1000,
          fmt::format("cone edges is {}, expected 3 to 1000", cone_edges));
  require(epsilon_min >= 0.0, fmt::format("epsilon_min is {}, expected 0 or more", epsilon_min));
  require(torque_scale >= 0.0,
          fmt::format("torque scale is {} m, expected 0 (the object's radius) or more", torque_scale));
  require(
      !hand.virtual_contacts.empty(),
      fmt::format(
          "the hand {} has no virtual contacts, expected some; give a contact file or add virtual_contacts "
          "to its hand.yaml",
          hand.name));
  return violations;
}

}  // namespace eigengrasp
