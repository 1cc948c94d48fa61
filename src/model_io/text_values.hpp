// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eigengrasp {

/// Units of the foreign formats: GraspIt! writes millimetres, grams and degrees.
inline constexpr double metres_of_mm = 1e-3;
inline constexpr double kilograms_of_g = 1e-3;
inline constexpr double radians_of_degree = 0.017453292519943295;

/// Without white space at either end.
std::string_view trimmed(std::string_view text);

/// The number that the whole text is (a leading + is allowed), whatever the locale. Numbers beyond 1e30 are
/// refused like infinite ones: no length, angle or mass is that large, and their squares would overflow.
std::optional<double> parse_number(std::string_view text);

/// Finite numbers separated by white space or commas; nothing where a part is not one.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// The whole number that the text is.
std::optional<int> parse_integer(std::string_view text);

/// a, b, c
std::string join(const std::vector<std::string>& names);

/// The known name that is closest to a mistyped one; empty where none is close.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// ` (did you mean "x"?)`, or nothing where no known name is close.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known);

/// Text made fit for a message: shortened, without control characters.
std::string shown(std::string_view text);

/// Ending of a file name in lower case, with its dot.
std::string lower_extension(const std::string& file_name);

}  // namespace eigengrasp
