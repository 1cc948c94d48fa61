// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <string>

namespace eigengrasp {

/// Where the library says what a user may want to know (a warning about units, a mended mesh). The library
/// itself never prints. An empty sink drops the message.
using LogSink = std::function<void(const std::string& sentence)>;

}  // namespace eigengrasp
