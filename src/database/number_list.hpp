// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace eigengrasp {

/// "{1,0.25,-3e-07}": as PostgreSQL writes an array, with as many digits as reading back exactly takes.
std::string format_numbers(std::span<const double> numbers);

/// @param where what errors call the text @throws Error where it is of another form
std::vector<double> parse_numbers(std::string_view text, const std::string& where);

}  // namespace eigengrasp
