// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/kernel_workspace.hpp"

#include <algorithm>
#include <limits>
#include <new>

namespace eigengrasp {

namespace {
constexpr std::align_val_t cache_line{64};
}

void KernelWorkspace::Release::operator()(float* memory) const {
  ::operator delete[](memory, cache_line);
}

KernelWorkspace::KernelWorkspace(const kernel::Program& p) {
  const int rows = 3 + 4 + p.n_amplitudes + 3 + p.n_dofs + 12 * p.n_bodies + 3 * p.n_parts + p.n_parts + 1;
  const auto count = static_cast<std::size_t>(rows) * kernel::n_lanes;
  memory_.reset(new (cache_line) float[count]());
  float* next = memory_.get();
  const auto take = [&](int n) {
    float* const taken = next;
    next += static_cast<std::size_t>(n) * kernel::n_lanes;
    return taken;
  };
  work_.position = take(3);
  work_.quaternion = take(4);
  work_.amplitudes = take(p.n_amplitudes);
  work_.threshold = take(1);
  work_.energy = take(1);
  work_.verdict = reinterpret_cast<std::int32_t*>(take(1));
  work_.dofs = take(p.n_dofs);
  work_.poses = take(12 * p.n_bodies);
  work_.centers = take(3 * p.n_parts);
  work_.unsure = reinterpret_cast<std::uint32_t*>(take(p.n_parts));
  work_.row = take(1);
  std::fill_n(work_.quaternion, kernel::n_lanes, 1.0f);
  std::fill_n(work_.threshold, kernel::n_lanes, std::numeric_limits<float>::infinity());
}

}  // namespace eigengrasp
