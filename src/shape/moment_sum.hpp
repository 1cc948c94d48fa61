// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <vector>

#include "eigengrasp/core/instruction_set.hpp"
#include "eigengrasp/shape/zernike_moments.hpp"
#include "shape/kernel/moment_tables.hpp"

namespace eigengrasp {

/// Adds up the moments of weighted points, in the order in which they come; the same bits for every
/// instruction set. Cost: about 0.1 us a point of order 20.
class MomentSum {
 public:
  explicit MomentSum(int order) : MomentSum(order, best_instruction_set()) {}
  /// @pre the processor has these instructions
  MomentSum(int order, InstructionSet set);

  /// @pre p in the unit ball (up to rounding)
  void add(const Vec3& p, double weight) {
    block_->x[filled_] = p.x();
    block_->y[filled_] = p.y();
    block_->z[filled_] = p.z();
    block_->weight[filled_] = weight;
    if (++filled_ == moment_kernel::block_size) flush();
  }

  /// Sums of weight * Z_nlm over all points so far, with 3/(4 pi) * integral of Z_nlm^2 = 1.
  ZernikeMoments moments();

 private:
  void flush();

  struct alignas(64) Eight {
    double lane[moment_kernel::n_lanes];
  };
  int order_ = 0;
  int filled_ = 0;
  const moment_kernel::Tables* tables_ = nullptr;
  moment_kernel::AddBlock add_block_ = nullptr;
  std::unique_ptr<moment_kernel::PointBlock> block_;
  std::unique_ptr<moment_kernel::Workspace> workspace_;
  std::vector<Eight> sums_;
};

}  // namespace eigengrasp
