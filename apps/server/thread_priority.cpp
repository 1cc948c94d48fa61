// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/thread_priority.hpp"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace eigengrasp::server {

void give_way() {
  constexpr int kNice = 10;  // Linux has one for each thread, and a new thread has its parent's
  const auto thread = static_cast<id_t>(::syscall(SYS_gettid));
  ::setpriority(PRIO_PROCESS, thread, kNice);  // where it is refused, all is as it was
}

}  // namespace eigengrasp::server
