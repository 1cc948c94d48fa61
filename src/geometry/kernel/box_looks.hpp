// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lanes.hpp"

/// Sixteen pairs of oriented boxes of two surfaces at once, in single precision. Plain data, as the kernels
/// of each instruction set take it.
namespace eigengrasp::box_kernel {

using kernel::n_lanes;

/// Surface b in the frame of a.
struct Placement {
  float rotation[3][3];
  float origin[3];  ///< [m]
  float rounding;   ///< [m] more than single precision may be off; boxes of b are larger by so much
};

/// A joint in the frame of a, see Screw.
struct Joint {
  float angular[3];
  float linear[3];
  float axis[3];  ///< unit
  float spin;     ///< length of angular
};

struct Motion {
  const Joint* joints;  ///< those of a first
  int n_of_a;
  int n;
  float margin;        ///< [m]
  float acceleration;  ///< [m/s^2]
  float outlook;       ///< [s] for such times the axis is chosen that tells the most
};

/// Rows 3 r + k: component r of axis k; 9 to 11: half sizes; 12 to 14: centres.
inline constexpr int n_box_rows = 15;

struct alignas(64) Pairs {
  float a[n_box_rows][n_lanes];
  float b[n_box_rows][n_lanes];  ///< in b's own frame
  float gap[n_lanes];            ///< out: lower bound of the distance [m]
  float time[n_lanes];           ///< out: for which they are sure to stay farther apart than the margin [s]
};

/// All variants give the same bits.
struct Functions {
  void (*gaps)(const Placement& place, Pairs& pairs);
  void (*times)(const Placement& place, const Motion& motion, Pairs& pairs);  ///< and gaps
};

extern const Functions baseline_functions;
extern const Functions avx2_functions;
extern const Functions avx512_functions;

}  // namespace eigengrasp::box_kernel
