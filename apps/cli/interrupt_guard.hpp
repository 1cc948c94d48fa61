// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/core/parallel.hpp"

namespace eigengrasp::cli {

/// While one lives, Ctrl-C asks the work to stop instead of ending the program. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Set by the first Ctrl-C; stays set.
  const StopFlag& stop_flag() const;
  bool interrupted() const { return stop_flag().stop_requested(); }

 private:
  void (*previous_)(int);
};

}  // namespace eigengrasp::cli
