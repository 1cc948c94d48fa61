// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/kernel_workspace.hpp"

#include <algorithm>
#include <limits>
#include <new>

namespace eigengrasp {

namespace {

constexpr std::align_val_t cache_line{64};

/// A word for sixteen cores, sixteen words a row.
int rows_of_near(const kernel::Program& p) {
  return (p.n_cores + 255) / 256;
}

int rows_of(const kernel::Program& p) {
  return 3 + 4 + p.n_amplitudes + 3 + p.n_dofs + 12 * p.n_bodies + 3 * p.n_parts + 3 * p.n_cores +
         rows_of_near(p) + 1 + kernel::n_approach_rows * p.n_contacts;
}

}  // namespace

void LaneRows::Release::operator()(float* memory) const {
  ::operator delete[](memory, cache_line);
}

LaneRows::LaneRows(int n_rows) {
  memory_.reset(new (cache_line) float[static_cast<std::size_t>(n_rows) * kernel::n_lanes]());
  next_ = memory_.get();
}

float* LaneRows::take(int n) {
  float* const taken = next_;
  next_ += static_cast<std::size_t>(n) * kernel::n_lanes;
  return taken;
}

KernelWorkspace::KernelWorkspace(const kernel::Program& p) : rows_(rows_of(p)) {
  work_.position = rows_.take(3);
  work_.quaternion = rows_.take(4);
  work_.amplitudes = rows_.take(p.n_amplitudes);
  work_.threshold = rows_.take(1);
  work_.energy = rows_.take(1);
  work_.verdict = reinterpret_cast<std::int32_t*>(rows_.take(1));
  work_.dofs = rows_.take(p.n_dofs);
  work_.poses = rows_.take(12 * p.n_bodies);
  work_.centers = rows_.take(3 * p.n_parts);
  work_.cores = rows_.take(3 * p.n_cores);
  work_.near = reinterpret_cast<std::uint32_t*>(rows_.take(rows_of_near(p)));
  work_.row = rows_.take(1);
  approaches_ = rows_.take(kernel::n_approach_rows * p.n_contacts);
  std::fill_n(work_.quaternion, kernel::n_lanes, 1.0f);
  std::fill_n(work_.threshold, kernel::n_lanes, std::numeric_limits<float>::infinity());
}

void KernelWorkspace::keep_approaches() {
  work_.approaches = approaches_;
}

KernelChains::KernelChains(int n_amplitudes) : rows_(3 + 4 + n_amplitudes + 4 + 4) {
  chains_.position = rows_.take(3);
  chains_.quaternion = rows_.take(4);
  chains_.amplitudes = rows_.take(n_amplitudes);
  chains_.energy = rows_.take(1);
  chains_.jump_temperature = rows_.take(1);
  chains_.log_range = rows_.take(1);
  chains_.acceptance_temperature = rows_.take(1);
  chains_.random = reinterpret_cast<std::int32_t*>(rows_.take(4));
}

}  // namespace eigengrasp
