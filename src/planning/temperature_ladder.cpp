// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/temperature_ladder.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace eigengrasp {

TemperatureLadder::TemperatureLadder(std::vector<double> temperatures, RandomStream random)
    : temperatures_(std::move(temperatures)),
      rung_(temperatures_.size()),
      chain_(temperatures_.size()),
      random_(random) {
  reset();
}

void TemperatureLadder::reset() {
  std::iota(rung_.begin(), rung_.end(), 0);
  std::iota(chain_.begin(), chain_.end(), 0);
}

void TemperatureLadder::exchange(const float* energies) {
  for (std::size_t low = static_cast<std::size_t>(first_); low + 1 < chain_.size(); low += 2) {
    int& cold = chain_[low];
    int& hot = chain_[low + 1];
    const double coldness = 1.0 / temperatures_[low] - 1.0 / temperatures_[low + 1];
    const double gain = static_cast<double>(energies[cold]) - static_cast<double>(energies[hot]);
    // Drawn in any case: the stream does not depend on the energies.
    if (const double u = random_.uniform(); u >= std::exp(std::fmin(0.0, coldness * gain))) continue;
    std::swap(cold, hot);
    std::swap(rung_[static_cast<std::size_t>(cold)], rung_[static_cast<std::size_t>(hot)]);
  }
  first_ = 1 - first_;
}

}  // namespace eigengrasp
