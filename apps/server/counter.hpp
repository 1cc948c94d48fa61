// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <atomic>
#include <memory>

namespace eigengrasp::server {

/// Counts what is open; a ticket is one of them.
class Counter {
 public:
  /// None where the most are open.
  static std::shared_ptr<void> take(const std::shared_ptr<Counter>& counter, int most) {
    if (counter->open_.fetch_add(1) >= most) {
      counter->open_.fetch_sub(1);
      return {};
    }
    return {counter.get(), [counter](void*) { counter->open_.fetch_sub(1); }};
  }

 private:
  std::atomic<int> open_{0};
};

}  // namespace eigengrasp::server
