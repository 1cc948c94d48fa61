// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/planning/grasp_planner.hpp"
#include "eigengrasp/transfer/stored_pregrasps.hpp"

namespace eigengrasp {

struct TransferOptions {
  /// None: by views, where only a part of the object was seen and the store has views; else by zernike.
  std::optional<NeighborDistance> distance;
  /// Alignment: where it is empty, pca-icp where only a part of the object was seen, else pca.
  CandidateOptions candidates = {.neighbors = 5, .most = 6, .alignment = "", .threads = 1};
  double min_epsilon = 0.0;          ///< threshold tau of Algorithm 1; form closure is asked for in any case
  std::vector<std::string> without;  ///< objects of the store that are not looked at
  std::vector<std::string> tags;     ///< the object's class, outermost first; of classes alone
  std::shared_ptr<const HandModel> from_hand;  ///< whose stored grasps are taken; null: the scene's hand
  /// Counts as in rate_pregrasps; threads and seed of all of it.
  PlanOptions plan;

  /// All violations as sentences: name, value, bound.
  std::vector<std::string> validate(const HandModel& hand) const;
};

struct TransferTimings {
  double prepare = 0.0;    ///< the hand's surfaces [s]
  double neighbors = 0.0;  ///< descriptor, search, alignments, stored grasps; at the same time [s]
  double rate = 0.0;       ///< fitting, closing, rating [s]
  double total = 0.0;
};

struct TransferResult {
  PlanResult plan;                       ///< form-closed grasps alone, by falling epsilon
  int distinct = 0;                      ///< before the best options.plan.grasps were taken
  std::vector<UsedNeighbor> neighbors;   ///< the most alike first
  std::vector<int> form_closed;          ///< of each neighbour's pre-grasps
  std::vector<CandidateOrigin> origins;  ///< of each grasp
  TransferTimings timings;
};

/// Grasps a new object by what is known of like ones: Algorithm 1 of the paper (docs/theory/transfer.md).
/// Neighbours by the distance; each at up to two scales (bracketing_scales), aligned, centres together;
/// rate_pregrasps for their stored pre-grasps, the nearest neighbour's first. The result depends on scene,
/// store and options alone, never on the number of threads (but for a time limit). An object that differs in
/// size from all its neighbours by more than kMostSizeRatio gets no grasps, and an explanation.
/// No distance fields are made: exact queries alone are quicker. Cost: 0.1-0.3 s for 50 pre-grasps, two
/// threads.
/// @throws Error where the options are not sound, the hand is another one than the store's of that name, and
/// as rank_neighbors and TransferTarget::find_candidates
TransferResult transfer_grasps(const Scene& scene, const TransferStore& store,
                               const TransferOptions& options);

}  // namespace eigengrasp
