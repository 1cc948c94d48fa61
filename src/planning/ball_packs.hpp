// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/geometry/sphere_cover.hpp"
#include "planning/kernel/program.hpp"

namespace eigengrasp {

/// The inner balls of all parts, neighbours together: sixteen to a pack, up to sixteen packs under a core.
class BallPacks {
 public:
  /// Appends the balls of a part and fills in which cores are the part's own.
  /// @param balls_B in the frame of the part's body
  void add(std::vector<Sphere> balls_B, kernel::Part& part);

  int n_cores() const { return static_cast<int>(cores_.size()); }
  const kernel::CoreBall* cores() const { return cores_.data(); }
  const kernel::CorePack* core_packs() const { return core_packs_.data(); }
  const kernel::ClusterPack* clusters() const { return clusters_.data(); }
  const kernel::BallPack* balls() const { return balls_.data(); }

 private:
  void add_core(const Sphere& core, double reach, int body);

  std::vector<kernel::CoreBall> cores_;
  std::vector<kernel::CorePack> core_packs_;
  std::vector<kernel::ClusterPack> clusters_;
  std::vector<kernel::BallPack> balls_;
};

}  // namespace eigengrasp
