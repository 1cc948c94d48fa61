// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "shape/kernel/moment_tables.hpp"

namespace eigengrasp::moment_kernel {

/// `width` doubles in a register.
template <int width>
struct Register {
  typedef double Type
      __attribute__((vector_size(width * sizeof(double)), may_alias));  // NOLINT: an attribute
};

#define EIGENGRASP_KERNEL [[gnu::always_inline]] inline

/// Calls work(register at offset i of every row) for all points.
template <int width, class Work>
EIGENGRASP_KERNEL void for_registers(Work work) {
  for (int i = 0; i < block_size; i += width) work(i);
}

template <int width>
EIGENGRASP_KERNEL typename Register<width>::Type& at(double* row, int i) {
  return *reinterpret_cast<typename Register<width>::Type*>(row + i);
}
template <int width>
EIGENGRASP_KERNEL const typename Register<width>::Type& at(const double* row, int i) {
  return *reinterpret_cast<const typename Register<width>::Type*>(row + i);
}

/// weight * R_nl(r) / r^l for n = l, l + 2, ..., by the recurrence of Jacobi polynomials in r^2.
template <int width>
EIGENGRASP_KERNEL void fill_radial(const Tables& t, const PointBlock& points, Workspace& w, int l) {
  const int count = (t.order - l) / 2 + 1;
  for_registers<width>(
      [&](int i) { at<width>(w.radial[0], i) = t.first_radial[l] * at<width>(points.weight, i); });
  for (int k = 1; k < count; ++k) {
    const double* last = w.radial[k - 1];
    const double* before = w.radial[k > 1 ? k - 2 : 0];  // times 0 where k is 1
    const double s = t.step_s[l][k], one = t.step_one[l][k], back = t.step_back[l][k];
    for_registers<width>([&](int i) {
      at<width>(w.radial[k], i) =
          (s * at<width>(w.r2, i) + one) * at<width>(last, i) - back * at<width>(before, i);
    });
  }
}

/// H_ll and H_l(-l): the last diagonal times x + iy.
template <int width>
EIGENGRASP_KERNEL void fill_diagonal(const Tables& t, const PointBlock& points, Workspace& w, int l) {
  const double c = t.diagonal[l];
  const double* cosine = w.harmonics[(l - 1) % 3][2 * (l - 1)];  // m = l - 1
  const double* sine = w.harmonics[(l - 1) % 3][0];              // m = -(l - 1)
  double* up_cosine = w.harmonics[l % 3][2 * l];
  double* up_sine = w.harmonics[l % 3][0];
  const double turned = l > 1 ? c : 0.0;  // the sine of m = 0 is 0
  for_registers<width>([&](int i) {
    const auto x = at<width>(points.x, i), y = at<width>(points.y, i);
    const auto a = at<width>(cosine, i), b = at<width>(sine, i);
    at<width>(up_cosine, i) = c * (x * a) - turned * (y * b);
    at<width>(up_sine, i) = c * (y * a) + turned * (x * b);
  });
}

/// The solid harmonics of degree l, real and orthonormal on the unit sphere, from those of l - 1 and l - 2.
template <int width>
EIGENGRASP_KERNEL void fill_harmonics(const Tables& t, const PointBlock& points, Workspace& w, int l) {
  if (l == 0) {
    const typename Register<width>::Type none = {};
    for_registers<width>([&](int i) { at<width>(w.harmonics[0][0], i) = none + t.first_harmonic; });
    return;
  }
  for (int m = 1 - l; m <= l - 1; ++m) {
    const int a = m < 0 ? -m : m;
    const double* last = w.harmonics[(l - 1) % 3][m + l - 1];
    const bool has_before = a <= l - 2;
    const double* before = has_before ? w.harmonics[(l - 2) % 3][m + l - 2] : last;
    const double up_z = t.up_z[l][a], up_r2 = has_before ? t.up_r2[l][a] : 0.0;
    double* row = w.harmonics[l % 3][m + l];
    for_registers<width>([&](int i) {
      at<width>(row, i) = up_z * (at<width>(points.z, i) * at<width>(last, i)) -
                          up_r2 * (at<width>(w.r2, i) * at<width>(before, i));
    });
  }
  fill_diagonal<width>(t, points, w, l);
}

/// Adds the products of `nr` radial rows and `nh` harmonics, each summed over the block in eight lanes.
template <int width, int nr, int nh>
EIGENGRASP_KERNEL void add_tile(const double (*radial)[block_size], const double (*harmonics)[block_size],
                                double* sums, int row_length) {
  using V = typename Register<width>::Type;
  for (int lane = 0; lane < n_lanes; lane += width) {
    V acc[nr][nh];
    for (int a = 0; a < nr; ++a)
      for (int b = 0; b < nh; ++b) acc[a][b] = at<width>(sums, (a * row_length + b) * n_lanes + lane);
    for (int i = lane; i < block_size; i += n_lanes)
      for (int a = 0; a < nr; ++a)
        for (int b = 0; b < nh; ++b) acc[a][b] += at<width>(radial[a], i) * at<width>(harmonics[b], i);
    for (int a = 0; a < nr; ++a)
      for (int b = 0; b < nh; ++b) at<width>(sums, (a * row_length + b) * n_lanes + lane) = acc[a][b];
  }
}

template <int width, int nr>
EIGENGRASP_KERNEL void add_rows(const double (*radial)[block_size], const double (*harmonics)[block_size],
                                double* sums, int row_length) {
  int m = 0;
  for (; m + 4 <= row_length; m += 4)
    add_tile<width, nr, 4>(radial, harmonics + m, sums + m * n_lanes, row_length);
  for (; m < row_length; ++m) add_tile<width, nr, 1>(radial, harmonics + m, sums + m * n_lanes, row_length);
}

template <int width>
void add_block(const Tables& t, const PointBlock& points, Workspace& w, double* sums) {
  for_registers<width>([&](int i) {
    const auto x = at<width>(points.x, i), y = at<width>(points.y, i), z = at<width>(points.z, i);
    at<width>(w.r2, i) = x * x + y * y + z * z;
  });
  for (int l = 0; l <= t.order; ++l) {
    fill_radial<width>(t, points, w, l);
    fill_harmonics<width>(t, points, w, l);
    const int count = (t.order - l) / 2 + 1, row = 2 * l + 1;
    const double(*harmonics)[block_size] = w.harmonics[l % 3];
    int k = 0;
    for (; k + 2 <= count; k += 2) add_rows<width, 2>(w.radial + k, harmonics, sums + k * row * n_lanes, row);
    if (k < count) add_rows<width, 1>(w.radial + k, harmonics, sums + k * row * n_lanes, row);
    sums += count * row * n_lanes;
  }
}

}  // namespace eigengrasp::moment_kernel
