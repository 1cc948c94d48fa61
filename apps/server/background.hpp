// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <atomic>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <thread>

namespace eigengrasp::server {

/// Threads for work that takes long. Their number is bounded by whoever asks (see Counter).
class Background {
 public:
  Background() = default;
  /// Waits for all; they were told to stop before.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  void run(std::function<void()> work);
  void wait_for_all();

 private:
  struct Runner {
    std::thread thread;
    std::shared_ptr<std::atomic<bool>> done;
  };
  std::mutex mutex_;
  std::list<Runner> runners_;
};

}  // namespace eigengrasp::server
