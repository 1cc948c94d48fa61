// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "eigengrasp/core/error.hpp"
#include "online/online_work.hpp"

namespace eigengrasp {

std::vector<std::string> OnlineOptions::validate(const HandModel& hand) const {
  std::vector<std::string> violations;
  const auto require = [&](bool sound, std::string sentence) {
    if (!sound) violations.push_back(std::move(sentence));
  };
  require(amplitudes >= 0 && amplitudes <= hand.n_dof(),
          fmt::format("eigengrasps is {}, expected 0 to {}, the degrees of freedom of {}", amplitudes,
                      hand.n_dof(), hand.name));
  require(cone_half_angle >= 0.0 && cone_half_angle <= 0.5 * std::numbers::pi,
          fmt::format("cone half angle is {} rad, expected 0 to pi/2", cone_half_angle));
  require(look_ahead > 0.0 && look_ahead <= 10.0,
          fmt::format("look-ahead is {} m, expected more than 0, at most 10", look_ahead));
  require(step_back >= 0.0 && step_back <= 1.0, fmt::format("step back is {} m, expected 0 to 1", step_back));
  require(restart_after >= 16 && restart_after <= 1'000'000,
          fmt::format("restart after {} iterations, expected 16 to 1,000,000", restart_after));
  require(queue >= 1 && queue <= 10000, fmt::format("queue is {}, expected 1 to 10000", queue));
  require(solutions >= 1 && solutions <= 1000, fmt::format("solutions is {}, expected 1 to 1000", solutions));
  require(epsilon_min >= 0.0, fmt::format("epsilon_min is {}, expected 0 or more", epsilon_min));
  require(test_threads >= 1 && test_threads <= 64,
          fmt::format("test threads is {}, expected 1 to 64", test_threads));
  require(preshape_begins > 0.0,
          fmt::format("preshape begins at {} m, expected more than 0", preshape_begins));
  require(!hand.virtual_contacts.empty(),
          fmt::format("the hand {} has no virtual contacts, expected some; add virtual_contacts to its "
                      "hand.yaml",
                      hand.name));
  return violations;
}

namespace {

struct NamedRange {
  const char* name;
  int count;  ///< -1: no index
};

NamedRange range_of(const VariableTarget& t, const HandModel& hand, int n_amplitudes) {
  switch (t.variable) {
    case VariableTarget::Variable::distance:
      return {"distance", -1};
    case VariableTarget::Variable::theta:
      return {"theta", -1};
    case VariableTarget::Variable::phi:
      return {"phi", -1};
    case VariableTarget::Variable::amplitude:
      return {"amplitude", n_amplitudes};
    case VariableTarget::Variable::dof:
      return {"dof", hand.n_dof()};
  }
  return {"?", 0};
}

}  // namespace

void check_targets(const std::vector<VariableTarget>& targets, const HandModel& hand, int n_amplitudes) {
  for (const VariableTarget& t : targets) {
    const auto [name, count] = range_of(t, hand, n_amplitudes);
    if (count >= 0 && (t.index < 0 || t.index >= count))
      throw Error(fmt::format("target of {} {}: expected an index from 0 to {}", name, t.index, count - 1));
    if (!std::isfinite(t.value))
      throw Error(fmt::format("target of {} {}: the value is not finite", name, t.index));
    if (!(t.confidence >= 0.0 && t.confidence <= 1.0))
      throw Error(
          fmt::format("target of {} {}: confidence is {}, expected 0 to 1", name, t.index, t.confidence));
  }
}

}  // namespace eigengrasp
