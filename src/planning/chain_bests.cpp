// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/chain_bests.hpp"

#include <algorithm>
#include <cmath>

namespace eigengrasp {

namespace {

/// Each of the three differences may be half of what makes two distinct: their squares sum up to 3/4.
constexpr double share = 0.5;

float square(double x) {
  return static_cast<float>(x * x);
}

/// Of the difference of n rows.
float squared_way(const float* a, int lane_a, const float* b, int lane_b, int n) {
  float sum = 0.0f;
  for (int i = 0; i < n; ++i) {
    const float d = a[i * kernel::n_lanes + lane_a] - b[i * kernel::n_lanes + lane_b];
    sum += d * d;
  }
  return sum;
}

}  // namespace

ChainBests::ChainBests(const EigengraspSpace& postures, const Distinctness& distinctness)
    : memory_(postures.size()),
      n_amplitudes_(postures.size()),
      most_shift_(square(share * distinctness.position)),
      least_cosine_(static_cast<float>(std::cos(0.5 * share * distinctness.rotation))),
      // The posture moves by no more than the basis' norm times the way of the amplitudes.
      most_amplitude_shift_(square(share * distinctness.posture / std::max(postures.basis().norm(), 1e-9))) {
  iteration_.fill(-1);
}

StateRows ChainBests::held() const {
  const kernel::Chains& chains = memory_.chains();
  return {chains.position, chains.quaternion, chains.amplitudes};
}

bool ChainBests::near(int chain, const StateRows& rows, int lane) const {
  const StateRows mine = held();
  if (squared_way(mine.position, chain, rows.position, lane, 3) > most_shift_) return false;
  if (squared_way(mine.amplitudes, chain, rows.amplitudes, lane, n_amplitudes_) > most_amplitude_shift_)
    return false;
  float cosine = 0.0f;
  for (int i = 0; i < 4; ++i)
    cosine += mine.quaternion[i * kernel::n_lanes + chain] * rows.quaternion[i * kernel::n_lanes + lane];
  return std::abs(cosine) > least_cosine_;
}

void ChainBests::hold(int chain, const StateRows& rows, int lane, float energy, std::int64_t iteration) {
  copy_lane(rows, lane, held(), chain, n_amplitudes_);
  memory_.chains().energy[chain] = energy;
  iteration_[static_cast<std::size_t>(chain)] = iteration;
}

}  // namespace eigengrasp
