// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>

namespace eigengrasp {

/// How many a second, over about the last second of work; idle time does not count.
class RateMeter {
 public:
  /// @param seconds of work that it took
  void add(std::int64_t count, double seconds) {
    constexpr double window = 1.0;  // [s]
    count_ += static_cast<double>(count);
    seconds_ += seconds;
    if (seconds_ > window) {
      count_ *= 0.5;
      seconds_ *= 0.5;
    }
  }
  double per_second() const { return seconds_ > 0.0 ? count_ / seconds_ : 0.0; }

 private:
  double count_ = 0.0;
  double seconds_ = 0.0;
};

}  // namespace eigengrasp
