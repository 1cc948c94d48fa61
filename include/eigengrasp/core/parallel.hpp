// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace eigengrasp {

/// Asked between units of work; set from a signal handler or another thread. Lock-free.
class StopFlag {
 public:
  void request_stop() { stop_.store(true, std::memory_order_relaxed); }
  bool stop_requested() const { return stop_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> stop_{false};
};

/// Number of threads that "all" means on this machine (at least 1).
int hardware_threads();

/// Calls work(index, worker) for every index in [0, count), each once, on up to n_threads threads; worker in
/// [0, n_threads) names the thread, for scratch memory. The order is free: results must not depend on it.
/// The first exception of a worker ends the loop and is rethrown here. n_threads <= 0 means all.
void parallel_for(std::size_t count, int n_threads, const std::function<void(std::size_t, int)>& work);

}  // namespace eigengrasp
