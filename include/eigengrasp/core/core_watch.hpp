// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <ctime>

namespace eigengrasp {

/// Time that the calling thread has had a core: what work costs, however busy the machine is.
class CoreWatch {
 public:
  CoreWatch() : start_(now()) {}
  /// Since it was made [s]. @pre asked by the thread that made it
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_;
};

}  // namespace eigengrasp
