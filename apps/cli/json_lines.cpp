// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/json_lines.hpp"

#include <fmt/core.h>

#include <cmath>
#include <sstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"

namespace eigengrasp::cli {

using nlohmann::json;

void JsonLine::fail_because(const std::string& sentence) const {
  throw Error(where + ": " + sentence);
}

const json& JsonLine::member(const char* name) const {
  static const json absent;
  const auto it = value.find(name);
  return it == value.end() ? absent : *it;
}

VecX json_numbers(const json& array, int count, const std::string& where, const std::string& what) {
  const bool sized = array.is_array() && (count == 0 || array.size() == static_cast<std::size_t>(count));
  if (!sized)
    fail("{}: {} is {}, expected an array of {}numbers", where, what,
         array.is_null() ? "missing" : array.dump().substr(0, 60),
         count > 0 ? fmt::format("{} ", count) : "");
  VecX v(static_cast<Eigen::Index>(array.size()));
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!array[i].is_number() || !std::isfinite(array[i].get<double>()))
      fail("{}: {}[{}] is {}, expected a finite number", where, what, i, array[i].dump());
    v[static_cast<Eigen::Index>(i)] = array[i].get<double>();
  }
  return v;
}

VecX JsonLine::numbers(const char* name, int count) const {
  return json_numbers(member(name), count, where, name);
}

double JsonLine::number(const char* name, double otherwise) const {
  const json& m = member(name);
  if (m.is_null()) return otherwise;
  if (!m.is_number() || !std::isfinite(m.get<double>()))
    fail("{}: {} is {}, expected a finite number", where, name, m.dump());
  return m.get<double>();
}

json parse_json(const std::string& text) {
  constexpr int deepest = 64;
  bool too_deep = false;
  const auto watch = [&](int depth, json::parse_event_t, json&) {
    too_deep |= depth > deepest;
    return depth <= deepest;
  };
  json parsed = json::parse(text, watch, false);
  if (too_deep) return json(json::value_t::discarded);
  return parsed;
}

std::vector<JsonLine> read_json_lines(const std::filesystem::path& file) {
  std::vector<JsonLine> lines;
  std::istringstream text(read_text_file(file));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    JsonLine parsed{parse_json(line), fmt::format("{}:{}", file.string(), number)};
    if (!parsed.value.is_object()) parsed.fail_because("is no JSON object, expected one object a line");
    lines.push_back(std::move(parsed));
  }
  return lines;
}

Pose parse_pose(const JsonLine& line, const char* member) {
  const json& m = line.member(member);
  if (!m.is_object())
    line.fail_because(
        fmt::format(R"({} is {}, expected {{"position": [x, y, z], "orientation": [w, x, y, z]}})", member,
                    m.is_null() ? "missing" : m.dump().substr(0, 60)));
  const JsonLine inner{m, line.where};
  const VecX q = inner.numbers("orientation", 4);
  if (q.norm() < 1e-6) line.fail_because("orientation is zero, expected a quaternion w, x, y, z");
  return make_pose(Eigen::Quaterniond(q[0], q[1], q[2], q[3]), inner.vector("position"));
}

json pose_json(const Pose& X) {
  const Eigen::Quaterniond q = orientation(X);
  const Vec3 p = X.translation();
  return {{"position", {p.x(), p.y(), p.z()}}, {"orientation", {q.w(), q.x(), q.y(), q.z()}}};
}

void print_line(const nlohmann::ordered_json& value) {
  fmt::print("{}\n", value.dump());
}

}  // namespace eigengrasp::cli
