// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/interrupt_guard.hpp"

#include <csignal>

namespace eigengrasp::cli {

namespace {

StopFlag flag;  // a signal handler reaches nothing else

}  // namespace

InterruptGuard::InterruptGuard() : previous_(std::signal(SIGINT, [](int) { flag.request_stop(); })) {}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, previous_);
}

const StopFlag& InterruptGuard::stop_flag() const {
  return flag;
}

}  // namespace eigengrasp::cli
