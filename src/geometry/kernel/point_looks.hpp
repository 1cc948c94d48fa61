// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lanes.hpp"

/// Sixteen points near each other against boxes and triangles, in single precision about a place among them.
/// Plain data, as the kernels of each instruction set take it.
namespace eigengrasp::point_kernel {

using kernel::n_lanes;

struct alignas(64) Points {
  float x[n_lanes], y[n_lanes], z[n_lanes];  ///< [m]
  float distance2[n_lanes];                  ///< of the nearest triangle so far, squared [m^2]
  float height2[n_lanes];                    ///< squared distance of that triangle's plane [m^2]
  std::int32_t triangle[n_lanes];            ///< its number
};

struct Functions {
  /// Whether a box is as near to any of the points as what is nearest so far. @param box least and largest
  /// corner
  bool (*reach_box)(const Points& points, const float (&box)[6]);
  /// Takes a triangle for the nearest one of the points to which it is; of those that share the nearest
  /// point, that which faces the point most. @param corners a, b, c
  void (*meet_triangle)(Points& points, const float (&corners)[9], std::int32_t number);
};

/// All variants give the same bits.
extern const Functions baseline_functions;
extern const Functions avx2_functions;
extern const Functions avx512_functions;

}  // namespace eigengrasp::point_kernel
