// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <vector>

#include "eigengrasp/geometry/preparation_cache.hpp"
#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/online/simulated_operator.hpp"

namespace eigengrasp::server {

struct ProbeOptions {
  double seconds = 10.0;
  double poses_per_second = 100.0;
  OperatorTraits traits;  ///< of who moves the wrist
  std::uint64_t seed = 1;
};

/// How long a wrist pose takes from a client to the hand on its screen [s]: from the pose handed to the
/// socket to the first view received that shows it, both on this machine, through a whole server on a free
/// port of the loopback address, while it plans. One value a pose that was shown.
/// @param scene of shipped models, or of files named as `serve` takes them: hand and object by name
/// @throws Error where the server cannot begin, or ends early
std::vector<double> measure_wire_latency(const Scene& scene, std::shared_ptr<PreparationCache> files,
                                         const ProbeOptions& options);

}  // namespace eigengrasp::server
