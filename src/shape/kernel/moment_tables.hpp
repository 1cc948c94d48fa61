// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

/// Sums of weighted points against all Zernike functions, eight points a step. Nothing of the standard
/// library is used here: the code is compiled with instructions that other processors may lack.
namespace eigengrasp::moment_kernel {

inline constexpr int n_lanes = 8;
inline constexpr int block_size = 64;  ///< points that are worked on together
inline constexpr int max_order = 40;

/// One block of points; what is unused has the weight 0.
struct alignas(64) PointBlock {
  double x[block_size];
  double y[block_size];
  double z[block_size];
  double weight[block_size];
};

/// Factors of the recurrences; see docs/theory/zernike.md.
struct Tables {
  int order = 0;
  double first_radial[max_order + 1];              ///< by l: sqrt(2 l + 3)
  double first_harmonic = 0.0;                     ///< 1 / sqrt(4 pi)
  double diagonal[max_order + 1];                  ///< H_ll from H_(l-1)(l-1), by l
  double up_z[max_order + 1][max_order + 1];       ///< H_lm from H_(l-1)m, by l and m
  double up_r2[max_order + 1][max_order + 1];      ///< H_lm from H_(l-2)m
  double step_s[max_order + 1][max_order + 1];     ///< R_(l+2k)l from the last, times r^2, by l and k
  double step_one[max_order + 1][max_order + 1];   ///< the same, times 1
  double step_back[max_order + 1][max_order + 1];  ///< R_(l+2k)l from the last but one
};

/// Memory of a thread. Rows of block_size numbers.
struct alignas(64) Workspace {
  double r2[block_size];
  double radial[max_order / 2 + 1][block_size];
  double harmonics[3][2 * max_order + 1][block_size];  ///< of l, l - 1 and l - 2 in turns; m = -l at 0
};

/// Adds a block to the sums: eight partial sums for each moment, by l, then n, then m.
using AddBlock = void (*)(const Tables&, const PointBlock&, Workspace&, double* sums);

extern const AddBlock add_block_baseline;
extern const AddBlock add_block_avx2;
extern const AddBlock add_block_avx512;

}  // namespace eigengrasp::moment_kernel
