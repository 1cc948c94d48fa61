// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace eigengrasp {

/// ["a","b"]: a list of texts as a JSON array, as SQL stores keep one in a column.
std::string format_texts(const std::vector<std::string>& texts);

/// @param where what errors call the text @throws Error where it is of another form
std::vector<std::string> parse_texts(std::string_view text, const std::string& where);

}  // namespace eigengrasp
