// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/planning/state_evaluator.hpp"
#include "planning/kernel/program.hpp"

namespace eigengrasp {

/// Rows of the variables of sixteen states: as in kernel::Workspace and kernel::Chains.
struct StateRows {
  float* position;
  float* quaternion;
  float* amplitudes;
};

/// Writes a state to a lane.
inline void put_lane(const HandState& state, int lane, const StateRows& rows) {
  const auto put = [lane](float* first, int row, double value) {
    first[row * kernel::n_lanes + lane] = static_cast<float>(value);
  };
  for (int i = 0; i < 3; ++i) put(rows.position, i, state.p_OA[i]);
  const double wxyz[] = {state.q_OA.w(), state.q_OA.x(), state.q_OA.y(), state.q_OA.z()};
  for (int i = 0; i < 4; ++i) put(rows.quaternion, i, wxyz[i]);
  for (int i = 0; i < state.amplitudes.size(); ++i) put(rows.amplitudes, i, state.amplitudes[i]);
}

/// The state of a lane.
inline HandState take_lane(int lane, const StateRows& rows, int n_amplitudes) {
  const auto at = [lane](const float* first, int row) {
    return static_cast<double>(first[row * kernel::n_lanes + lane]);
  };
  HandState state;
  for (int i = 0; i < 3; ++i) state.p_OA[i] = at(rows.position, i);
  state.q_OA = Eigen::Quaterniond(at(rows.quaternion, 0), at(rows.quaternion, 1), at(rows.quaternion, 2),
                                  at(rows.quaternion, 3))
                   .normalized();
  state.amplitudes.resize(n_amplitudes);
  for (int i = 0; i < n_amplitudes; ++i) state.amplitudes[i] = at(rows.amplitudes, i);
  return state;
}

/// Copies a lane of `from` to a lane of `to`.
inline void copy_lane(const StateRows& from, int lane, const StateRows& to, int to_lane, int n_amplitudes) {
  const auto copy = [&](const float* a, float* b, int n) {
    for (int i = 0; i < n; ++i) b[i * kernel::n_lanes + to_lane] = a[i * kernel::n_lanes + lane];
  };
  copy(from.position, to.position, 3);
  copy(from.quaternion, to.quaternion, 4);
  copy(from.amplitudes, to.amplitudes, n_amplitudes);
}

}  // namespace eigengrasp
