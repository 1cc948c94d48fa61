// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "online/candidate_queue.hpp"

#include <algorithm>

namespace eigengrasp {

bool CandidateQueue::add(PreGrasp candidate) {
  if (!waiting_.admits(candidate.energy)) return false;
  const bool known = std::any_of(tested_.begin(), tested_.end(), [&](const PreGrasp& t) {
    return candidate.energy > t.energy - much_better && distinct_.between(candidate, t) < 1.0;
  });
  return !known && waiting_.add(std::move(candidate));
}

std::optional<PreGrasp> CandidateQueue::take() {
  std::optional<PreGrasp> best = waiting_.take_best();
  if (!best) return best;
  if (tested_.size() < memory) {
    tested_.push_back(*best);
  } else {
    tested_[next_] = *best;
  }
  next_ = (next_ + 1) % memory;
  return best;
}

void CandidateQueue::clear(bool tested) {
  waiting_.clear();
  if (!tested) return;
  tested_.clear();
  next_ = 0;
}

}  // namespace eigengrasp
