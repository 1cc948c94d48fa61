// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/number_list.hpp"

#include <fmt/format.h>

#include <charconv>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

std::string format_numbers(std::span<const double> numbers) {
  return fmt::format("{{{}}}", fmt::join(numbers, ","));
}

std::vector<double> parse_numbers(std::string_view text, const std::string& where) {
  std::vector<double> numbers;
  const char* p = text.data();
  const char* end = p + text.size();
  const auto expected = [&] {
    fail("{}: found '{}', expected numbers such as {{1,2}}", where, text.substr(0, 60));
  };
  if (text.size() < 2 || text.front() != '{' || text.back() != '}') expected();
  ++p;
  --end;
  while (p < end) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(p, end, value);
    if (error != std::errc() || (next != end && (*next != ',' || next + 1 == end))) expected();
    numbers.push_back(value);
    p = next + 1;
  }
  return numbers;
}

}  // namespace eigengrasp
