// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace eigengrasp {

/// Bad input: one sentence that says what was found, what was expected and how to mend it. Programs print it
/// and end with exit code 2. Expected outcomes (no grasp found) are statuses, programmer errors
/// std::logic_error.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Error with a formatted sentence.
template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

/// Throws Error "FILE:LINE: sentence"; the line is left out where it is 0.
template <typename... Args>
[[noreturn]] void fail_at(const std::filesystem::path& file, int line, fmt::format_string<Args...> format,
                          Args&&... args) {
  const std::string where = line > 0 ? fmt::format("{}:{}", file.string(), line) : file.string();
  throw Error(fmt::format("{}: {}", where, fmt::format(format, std::forward<Args>(args)...)));
}

}  // namespace eigengrasp
