// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>

#include "eigengrasp/planning/pregrasp_list.hpp"
#include "planning/kernel_workspace.hpp"
#include "planning/lane_state.hpp"

namespace eigengrasp {

/// Of each chain the best state about where it is now. A chain accepts many states that are much the same;
/// only the best of them need be looked at by a PreGraspList, and only once the chain has gone elsewhere.
class ChainBests {
 public:
  /// @param distinctness states that are kept back for a better one are not distinct from it
  ChainBests(const EigengraspSpace& postures, const Distinctness& distinctness);

  bool holds(int chain) const { return iteration_[static_cast<std::size_t>(chain)] >= 0; }
  /// Whether the state of a lane is about where the one that is held is: not distinct from it for sure.
  /// @pre holds(chain)
  bool near(int chain, const StateRows& rows, int lane) const;
  void hold(int chain, const StateRows& rows, int lane, float energy, std::int64_t iteration);
  void drop(int chain) { iteration_[static_cast<std::size_t>(chain)] = -1; }

  /// @pre holds(chain)
  HandState state(int chain) const { return take_lane(chain, held(), n_amplitudes_); }
  float energy(int chain) const { return memory_.chains().energy[chain]; }
  std::int64_t iteration(int chain) const { return iteration_[static_cast<std::size_t>(chain)]; }

 private:
  StateRows held() const;

  KernelChains memory_;
  int n_amplitudes_;
  std::array<std::int64_t, kernel::n_lanes> iteration_;
  float most_shift_;            ///< squared [m^2]
  float least_cosine_;          ///< of half the turn
  float most_amplitude_shift_;  ///< squared
};

}  // namespace eigengrasp
