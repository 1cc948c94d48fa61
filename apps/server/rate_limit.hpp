// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>

#include "server/client.hpp"

namespace eigengrasp::server {

/// Lets so many events a second pass, and a second's worth at once.
class RateLimit {
 public:
  RateLimit(double per_second, Clock::time_point now)
      : per_second_(per_second), left_(per_second), last_(now) {}

  bool pass(Clock::time_point now) {
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    left_ = std::min(per_second_, left_ + per_second_ * seconds);
    if (left_ < 1.0) return false;
    left_ -= 1.0;
    return true;
  }

 private:
  double per_second_;
  double left_;
  Clock::time_point last_;
};

}  // namespace eigengrasp::server
