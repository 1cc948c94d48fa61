// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>

#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/database/grasp_store.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"

namespace eigengrasp {

/// A stored grasp that does not come out again.
struct UnverifiedGrasp {
  UnitKey key;
  std::int64_t id = 0;
  std::string reason;  ///< a sentence's middle: "has epsilon 0.1, stored is 0.2"
};

struct VerifyOptions {
  std::vector<std::shared_ptr<const HandModel>> hands;  ///< only grasps with these
  std::vector<std::string> objects = {};                ///< only of these; empty: of all
  int every = 1;  ///< of the grasps of an object and a hand the first and then each so many-th
  int threads = 0;
  std::shared_ptr<PreparationCache> cache = {};
  const StopFlag* stop = nullptr;
  std::function<void(double share)> progress = {};  ///< called by one thread at a time; may be empty
};

struct VerifyReport {
  std::int64_t grasps = 0;           ///< that were simulated again
  std::int64_t foreign = 0;          ///< that no planner of ours made: without pre-grasp and named joints
  std::vector<UnverifiedGrasp> bad;  ///< in the order of the store's objects
  bool stopped = false;
};

/// Simulates stored grasps again: the pre-grasp has to be free by exact meshes, and closing it has to end in
/// the same joints (1 mrad), contacts (0.2 mm), epsilon (0.001 and 1 %) and form closure. What this program
/// stored on such a machine comes out bit by bit; the last digit of a pose that came through a file or
/// another processor shifts where fingers stop within the contact gap.
/// Cost: 2-5 ms a grasp, and the preparation of each object.
VerifyReport verify_grasps(GraspStore& store, const VerifyOptions& options);

}  // namespace eigengrasp
