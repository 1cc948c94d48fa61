// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// How a unit of work is planned. A search ends with its grasps, or where its states are spent: both do not
/// depend on the machine. The time limit is there for what was not foreseen.
struct UnitOptions {
  int grasps = 15;
  std::int64_t states = 100000;
  double time_limit = 60.0;  ///< [s] > 0
  std::uint64_t seed = 1;

  /// All violations as sentences: name, value, bound.
  std::vector<std::string> validate() const;
};

/// The source of grasps that are planned here.
GraspSource builder_source();

/// Plans a unit by the enhanced search, on one thread. Failed, with the reason, where no form-closed grasp
/// was found. Where the time limit ended the search the reason says so, also beside grasps. Its seconds are
/// those of the core that this thread had.
/// @param stop what was found until then is thrown away @returns none where it was stopped
std::optional<UnitResult> plan_unit(const UnitKey& key, const PreparedHand& hand, PreparedObject& object,
                                    const UnitOptions& options, const StopFlag* stop);

}  // namespace eigengrasp
