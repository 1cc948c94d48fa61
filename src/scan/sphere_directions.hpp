// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// `count` unit vectors spread evenly over the sphere (golden spiral), always the same.
inline std::vector<Vec3> sphere_directions(int count) {
  std::vector<Vec3> directions;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  return directions;
}

}  // namespace eigengrasp
