// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp::cli {

/// One JSON object with the place that errors name: "FILE:LINE".
struct JsonLine {
  nlohmann::json value;
  std::string where;

  /// A member, or null where it is absent.
  const nlohmann::json& member(const char* name) const;
  /// Numbers of a member. @throws Error where it is absent, no array of that many (0: any number of) finite
  /// numbers.
  VecX numbers(const char* name, int count = 0) const;
  Vec3 vector(const char* name) const { return numbers(name, 3); }
  double number(const char* name, double otherwise) const;
  [[noreturn]] void fail_because(const std::string& sentence) const;
};

/// Finite numbers of a JSON array. @param what and where: for the error
VecX json_numbers(const nlohmann::json& array, int count, const std::string& where, const std::string& what);

/// JSON of a text; discarded where it is none, or nested deeper than any input of ours.
nlohmann::json parse_json(const std::string& text);

/// The lines that are not blank, in order. @throws Error with file and line for text that is no JSON object.
std::vector<JsonLine> read_json_lines(const std::filesystem::path& file);

/// A pose as {"position": [m], "orientation": [w, x, y, z]}.
Pose parse_pose(const JsonLine& line, const char* member);
nlohmann::json pose_json(const Pose& X);

/// Prints one line of JSON to stdout.
void print_line(const nlohmann::ordered_json& value);

}  // namespace eigengrasp::cli
