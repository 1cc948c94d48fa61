// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

namespace eigengrasp {

// A worker of a build is a thread of a process on a machine: HOST:PID.START/THREAD, where START tells
// processes that come to have the same PID apart.

std::string worker_name(int thread);

/// HOST; all of it where it is no such name.
std::string host_of_worker(const std::string& worker);

/// Whether it was a worker of this machine whose process has ended: what it holds can be given back at once.
bool has_ended_here(const std::string& worker);

}  // namespace eigengrasp
