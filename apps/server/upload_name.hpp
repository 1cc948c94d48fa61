// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

namespace eigengrasp::server {

/// What an upload is called on the server: letters, digits, '.', '_' and '-', at most 48; does not begin with
/// a dot. @param otherwise put before a name that would be empty or begin so
std::string sound_name(const std::string& wanted, const std::string& otherwise);

/// The ending of a file's name in small letters, with its dot.
std::string ending_of(const std::string& file_name);

}  // namespace eigengrasp::server
