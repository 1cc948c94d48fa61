// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <vector>

#include "eigengrasp/core/random.hpp"

namespace eigengrasp {

/// Parallel tempering (replica exchange, Swendsen and Wang 1986, Geyer 1991): each chain walks at a
/// temperature of its own, and from time to time chains at neighbouring temperatures trade them. If every
/// chain by itself keeps the Boltzmann distribution of its temperature, so do all together.
class TemperatureLadder {
 public:
  /// @param temperatures rising, all positive [energy units]; chain i begins at the ith
  /// @param random stream of the exchanges
  TemperatureLadder(std::vector<double> temperatures, RandomStream random);

  int size() const { return static_cast<int>(temperatures_.size()); }
  /// Place of a chain's temperature, 0 the coldest.
  int rung(int chain) const { return rung_[static_cast<std::size_t>(chain)]; }
  double temperature(int chain) const { return temperatures_[static_cast<std::size_t>(rung(chain))]; }

  /// Chain i back to the ith temperature.
  void reset();

  /// Chains i and j at neighbouring temperatures trade them with probability
  /// min(1, exp((1/T_i - 1/T_j) (E_i - E_j))). Pairs (0, 1), (2, 3), ... and (1, 2), (3, 4), ... take turns.
  /// @param energies (size()) of the chains' states
  void exchange(const float* energies);

 private:
  std::vector<double> temperatures_;
  std::vector<int> rung_;   ///< of each chain
  std::vector<int> chain_;  ///< on each rung
  RandomStream random_;
  int first_ = 0;  ///< lower rung of the next exchange's first pair: 0 or 1
};

}  // namespace eigengrasp
