// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>

#include "eigengrasp/database/grasp_store.hpp"

namespace eigengrasp {

struct CopyReport {
  std::int64_t models = 0, hands = 0, units = 0, grasps = 0;  ///< new in the target
  std::int64_t kept_units = 0;  ///< with grasps or an outcome in the target already, which stay as they are
};

/// Adds to a store what another one holds; afterwards, into an empty one, both hold the same, but for ids and
/// claims: a claimed unit waits in the copy. Goes on where an earlier copy was cut short.
CopyReport copy_store(GraspStore& from, GraspStore& to);

}  // namespace eigengrasp
