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

/// Floats of a box: component r of axis k at 4 r + k, half sizes from 12 and the centre from 16 on.
inline constexpr int box_stride = 20;

/// Boxes of the two surfaces, and numbers of sixteen pairs of them. All numbers are of boxes that there are.
struct alignas(64) Pairs {
  std::int32_t a[n_lanes];
  std::int32_t b[n_lanes];
  float gap[n_lanes];   ///< out: lower bound of the distance [m]
  float time[n_lanes];  ///< out: for which they are sure to stay farther apart than the margin [s]
  const float* boxes_a;
  const float* boxes_b;  ///< in b's own frame
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
