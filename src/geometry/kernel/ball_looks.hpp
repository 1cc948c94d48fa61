// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lanes.hpp"

/// Sixteen balls of a moving surface against the distance field of one at rest, in single precision. Plain
/// data, as the kernels of each instruction set take it.
namespace eigengrasp::ball_kernel {

using kernel::n_lanes;

/// Distances on a regular grid.
struct GridView {
  const std::int32_t* values;  ///< of floats the bits, x fastest
  float origin[3];             ///< of node (0, 0, 0) [m]
  float last[3];               ///< nodes - 1 along the axes
  float cell;                  ///< [m]
  float inverse_cell;
  std::int32_t row;    ///< nodes along x
  std::int32_t layer;  ///< nodes along x times nodes along y
};

struct Joint {
  float angular[3];
  float linear[3];
};

/// The moving surface in the frame of the field.
struct Motion {
  GridView fine;    ///< inside of the coarse one
  GridView coarse;  ///< holds the whole surface at rest
  float scale;      ///< of the fields' values
  float rotation[3][3];
  float origin[3];
  const Joint* joints;
  int n;
  float margin;        ///< [m], and what single precision may be off
  float acceleration;  ///< [m/s^2]
};

struct alignas(64) BallPack {
  float x[n_lanes], y[n_lanes], z[n_lanes];  ///< in the frame of the surface
  float radius[n_lanes];                     ///< far below 0 for the ones that only fill up
};

struct Functions {
  /// Times [s] for which the balls are sure to stay farther from the surface at rest than the margin.
  /// @param times (16) out, aligned to 64 bytes
  void (*times)(const Motion& motion, const BallPack& balls, float* times);
};

extern const Functions baseline_functions;
extern const Functions avx2_functions;
extern const Functions avx512_functions;

}  // namespace eigengrasp::ball_kernel
