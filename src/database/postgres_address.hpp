// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

namespace eigengrasp {

/// postgresql://user@host/database, for messages.
std::string without_password(const std::string& url);

/// Throws Error, one sentence, from what libpq said when it could not connect.
/// @param was_there the server answered before, so that it may come back: TransientError instead of Error
[[noreturn]] void complain_of_connection(const std::string& place, const std::string& message,
                                         bool was_there);

std::string first_line(const std::string& text);

}  // namespace eigengrasp
