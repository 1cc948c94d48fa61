// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "eigengrasp/planning/pregrasp_list.hpp"

namespace eigengrasp {

/// Pre-grasps that wait for the second stage. The best comes out first; what is like one that waits with a
/// lower energy, or like one that was tested, is not taken in, unless it is much better than that was. Not
/// safe to share without a lock.
class CandidateQueue {
 public:
  CandidateQueue(std::size_t capacity, const Distinctness& distinctness)
      : waiting_(capacity, distinctness), distinct_(distinctness) {}

  /// True where the candidate was taken in; the worst goes where the queue is full.
  bool add(PreGrasp candidate);
  /// The best that waits; from now on it counts as tested.
  std::optional<PreGrasp> take();
  bool empty() const { return waiting_.items().empty(); }
  /// Forgets what waits, and with `tested` also what was tested.
  void clear(bool tested);

 private:
  static constexpr std::size_t memory = 256;   ///< tested ones that are remembered
  static constexpr double much_better = 10.0;  ///< [energy units]

  PreGraspList waiting_;
  Distinctness distinct_;
  std::vector<PreGrasp> tested_;  ///< a ring
  std::size_t next_ = 0;
};

}  // namespace eigengrasp
