// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/database/grasp_store.hpp"

namespace eigengrasp {

/// What a store holds with one hand: a line of Table III.
struct HandStatistics {
  std::string hand;
  std::int64_t units = 0;  ///< of work
  std::int64_t done = 0;
  std::int64_t failed = 0;
  std::int64_t grasps = 0;
  std::int64_t form_closed = 0;
  double seconds = 0.0;               ///< of a core that the units took together
  double median_seconds = 0.0;        ///< of a unit that ended
  std::vector<double> epsilons = {};  ///< of the form-closed grasps, rising
};

/// Units without grasps that failed for the same kind of reason.
struct FailureStatistics {
  std::string kind;  ///< the reason up to its first colon, without numbers
  std::int64_t units = 0;
  UnitKey example;
  std::string reason;  ///< of the example
};

struct StoreStatistics {
  std::vector<HandStatistics> hands;        ///< in the order of the store
  std::vector<FailureStatistics> failures;  ///< the most frequent first
  std::int64_t objects = 0;
  std::int64_t objects_without_grasps = 0;  ///< of those that all units have ended of
  std::int64_t limited = 0;                 ///< units that the time limit ended
};

/// Reads all units and grasps: some seconds for 250,000 grasps.
StoreStatistics compute_statistics(GraspStore& store);

/// The value below which a share of the sorted values lie, 0 where there are none. @param share in [0, 1]
double quantile(const std::vector<double>& sorted, double share);

/// Who works on a store at the moment.
struct ActiveHost {
  std::string host;
  int workers = 0;           ///< threads with a lease that lasts
  std::int64_t claimed = 0;  ///< units
  std::int64_t ended = 0;    ///< by workers of this host, now and before
};

struct BuildStatus {
  StoreCounts counts;
  std::vector<ActiveHost> hosts;
  double mean_seconds = 0.0;  ///< of a unit that ended, over all
  double rate = 0.0;          ///< units a second at most: if each active worker has a core of its own
  double remaining = 0.0;     ///< [s] at that rate, at least; infinity without workers
  std::vector<std::pair<UnitKey, std::string>> failures;  ///< the newest of the store's order last
};

/// @param now [s since 1970]
BuildStatus compute_status(GraspStore& store, double now);

}  // namespace eigengrasp
