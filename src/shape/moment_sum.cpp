// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/moment_sum.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace eigengrasp {

namespace {

using moment_kernel::max_order;
using moment_kernel::Tables;

/// P_k^(0,beta)(2 s - 1) from the two before it, as in Abramowitz and Stegun 22.7.1; the rows of the table
/// also hold the norm sqrt(2 n + 3), n = l + 2 k.
void fill_radial_steps(Tables& t, int l) {
  const double beta = l + 0.5;
  t.first_radial[l] = std::sqrt(2.0 * l + 3.0);
  for (int k = 1; l + 2 * k <= max_order; ++k) {
    const double j = k - 1.0;
    const double c = 2.0 * j + beta;
    const double divisor = 2.0 * k * (k + beta) * c;
    const double norm = std::sqrt((2.0 * (l + 2 * k) + 3.0) / (2.0 * (l + 2 * k) - 1.0));
    const double norm_2 = k > 1 ? std::sqrt((2.0 * (l + 2 * k) + 3.0) / (2.0 * (l + 2 * k) - 5.0)) : 0.0;
    const double slope = (c + 1.0) * (c + 2.0) * c / divisor;
    const double offset = -(c + 1.0) * beta * beta / divisor;
    t.step_s[l][k] = norm * 2.0 * slope;
    t.step_one[l][k] = norm * (offset - slope);
    t.step_back[l][k] = norm_2 * 2.0 * j * (j + beta) * (c + 2.0) / divisor;
  }
}

/// Orthonormal Legendre functions by degree.
void fill_harmonic_steps(Tables& t, int l) {
  if (l == 0) return;
  t.diagonal[l] = std::sqrt((2.0 * l + 1.0) / (2.0 * l) * (l == 1 ? 2.0 : 1.0));
  for (int m = 0; m < l; ++m) {
    const double d = 1.0 * l * l - 1.0 * m * m;
    t.up_z[l][m] = std::sqrt((4.0 * l * l - 1.0) / d);
    const double before = (l - 1.0) * (l - 1.0) - 1.0 * m * m;
    t.up_r2[l][m] = m < l - 1 ? std::sqrt((2.0 * l + 1.0) / (2.0 * l - 3.0) * before / d) : 0.0;
  }
}

Tables make_tables(int order) {
  Tables t{};
  t.order = order;
  t.first_harmonic = std::sqrt(1.0 / (4.0 * std::numbers::pi));
  for (int l = 0; l <= max_order; ++l) {
    fill_radial_steps(t, l);
    fill_harmonic_steps(t, l);
  }
  return t;
}

const Tables& tables_of(int order) {
  static const auto all = [] {
    std::vector<Tables> tables;
    for (int n = 0; n <= max_order; ++n) tables.push_back(make_tables(n));
    return tables;
  }();
  return all.at(static_cast<std::size_t>(order));
}

moment_kernel::AddBlock kernel_of([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return moment_kernel::add_block_avx512;
  if (set == InstructionSet::avx2) return moment_kernel::add_block_avx2;
#endif
  return moment_kernel::add_block_baseline;
}

}  // namespace

MomentSum::MomentSum(int order, InstructionSet set)
    : order_(order),
      tables_(&tables_of(order)),
      add_block_(kernel_of(set)),
      block_(std::make_unique<moment_kernel::PointBlock>()),
      workspace_(std::make_unique<moment_kernel::Workspace>()),
      sums_(ZernikeMoments(order).values().size()) {}

void MomentSum::flush() {
  for (int i = filled_; i < moment_kernel::block_size; ++i)
    block_->x[i] = block_->y[i] = block_->z[i] = block_->weight[i] = 0.0;
  add_block_(*tables_, *block_, *workspace_, sums_.front().lane);
  filled_ = 0;
}

ZernikeMoments MomentSum::moments() {
  if (filled_ > 0) flush();
  ZernikeMoments moments(order_);
  const double norm = std::sqrt(4.0 * std::numbers::pi / 3.0);
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const auto& s = sums_[i].lane;
    moments.values()[i] = norm * (((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])));
  }
  return moments;
}

}  // namespace eigengrasp
