// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>

#include "eigengrasp/database/grasp_store.hpp"
#include "eigengrasp/jobs/unit_planner.hpp"

namespace eigengrasp {

struct BuildProgress {
  std::int64_t units = 0;      ///< of the store, whoever works on them
  std::int64_t ended = 0;      ///< of those, done or failed
  std::int64_t ended_now = 0;  ///< by this call
  std::int64_t failed_now = 0;
  std::int64_t grasps_now = 0;
  double seconds = 0.0;  ///< since the call
};

struct BuildOptions {
  std::vector<std::shared_ptr<const HandModel>> hands;
  std::vector<double> scales = {0.75, 1.0, 1.25, 1.5};  ///< ascending, > 0
  UnitOptions unit;
  int jobs = 0;  ///< threads, each with an object of its own; 0: all. Does not change the result
  bool retry_failed = false;
  bool only_waiting = false;  ///< adds nothing to the store: units that wait are built, of whatever scale
  std::shared_ptr<PreparationCache> cache = {};  ///< of what is made of the hands' meshes
  /// How long units stay with a worker that is not heard of any more. A unit that takes longer is planned
  /// twice, and stored once. 0: three time limits and two minutes.
  double lease = 0.0;
  const StopFlag* stop = nullptr;  ///< ends the units in hand without outcome; they wait again
  std::function<void(const BuildProgress&)> progress = {};  ///< called by one thread at a time; may be empty

  /// All violations as sentences: name, value, bound.
  std::vector<std::string> validate() const;
};

struct BuildReport {
  BuildProgress end;
  bool stopped = false;
};

/// Adds the hands and the units that a build of these options works on, where they are not there yet.
void add_work(GraspStore& store, const BuildOptions& options);

/// Plans grasps for every object of the store at every scale with every hand, unit by unit (section V-C). A
/// unit is stored as soon as it ends: where the program is killed, what is in hand is lost and waits again,
/// as soon as another call on the same machine starts or waits, else when the lease of the claim ends. What
/// waited before with other hands or scales is built as well. Any number of calls, on any machines, may build
/// one store. An object is read and prepared once for all its units. A call that finds nothing to claim waits
/// for what others hold, as their leases may end: when it returns, every unit has ended. What is stored does
/// not depend on jobs, interruptions or order.
/// @throws Error where the options are not sound, the store cannot be written, or units wait for a hand that
/// is not given
BuildReport build_database(GraspStore& store, const BuildOptions& options);

}  // namespace eigengrasp
