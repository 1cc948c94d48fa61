// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

namespace eigengrasp {

/// postgresql://user@host/database, for messages.
std::string without_password(const std::string& url);

/// Throws Error, one sentence, from what libpq said when it could not connect.
/// @param may_come the server is known to be there, and may come back: TransientError instead of Error
[[noreturn]] void complain_of_connection(const std::string& place, const std::string& message, bool may_come);

std::string first_line(const std::string& text);

}  // namespace eigengrasp
