// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/geometry/sphere_cover.hpp"
#include "planning/kernel/program.hpp"

namespace eigengrasp {

/// The inner balls of all parts, sixteen to a pack, neighbours together, under clusters of clusters.
class BallPacks {
 public:
  /// Appends the balls of a part and fills in which packs are the part's own.
  /// @param balls_B in the frame of the part's body
  void add(std::vector<Sphere> balls_B, kernel::Part& part);

  const kernel::ClusterPack* clusters() const { return clusters_.data(); }
  const kernel::BallPack* balls() const { return balls_.data(); }

 private:
  std::vector<kernel::ClusterPack> clusters_;
  std::vector<kernel::BallPack> balls_;
};

}  // namespace eigengrasp
