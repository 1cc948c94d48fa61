// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/geometry/sphere_cover.hpp"
#include "planning/kernel/program.hpp"

namespace eigengrasp {

/// A few large balls of each part that are tried before all others.
class PartCores {
 public:
  /// Appends the cores of a part: its largest ball, then those that are large and far from the ones before.
  /// @param balls_B in the frame of the part's body  @param number of the part
  void add(const std::vector<Sphere>& balls_B, int number, kernel::Part& part);

  int size() const { return static_cast<int>(cores_.size()); }
  const kernel::CoreBall* cores() const { return cores_.data(); }
  const kernel::CorePack* packs() const { return packs_.data(); }

 private:
  std::vector<kernel::CoreBall> cores_;
  std::vector<kernel::CorePack> packs_;
};

}  // namespace eigengrasp
