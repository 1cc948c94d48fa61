// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// A value of a YAML file that knows its file and its name, so that every complaint says file, line and name.
/// All readers throw Error for values that are missing, malformed or not finite.
class YamlValue {
 public:
  /// The whole file. @throws Error where it cannot be read or is not well-formed, with the line.
  static YamlValue load(const std::filesystem::path& file);

  const std::filesystem::path& file() const { return *file_; }
  const std::string& name() const { return name_; }
  int line() const;

  /// Keys and values of a map, in their order. @throws Error for another kind of value, a key that is not
  /// text, and a key that comes twice.
  std::vector<std::pair<std::string, YamlValue>> fields() const;
  /// As fields(), and @throws Error for a key that is not known, with the nearest one.
  std::vector<std::pair<std::string, YamlValue>> fields(const std::vector<std::string>& known) const;
  /// The value of a key of a map.
  std::optional<YamlValue> find(const std::string& key) const;
  YamlValue require(const std::string& key) const;
  /// The items of a list.
  std::vector<YamlValue> items() const;

  std::string text() const;
  double number() const;
  /// Numbers of a list. @throws Error unless there are exactly `count`.
  std::vector<double> numbers(std::size_t count) const;
  Vec3 vector() const;
  /// A vector made a unit vector. @throws Error for zero.
  Vec3 direction() const;
  /// The value as written, shortened.
  std::string written() const;

  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    fail_at(*file_, line(), format, std::forward<Args>(args)...);
  }

 private:
  YamlValue(std::shared_ptr<const std::filesystem::path> file, const YAML::Node& node, std::string name)
      : file_(std::move(file)), node_(node), name_(std::move(name)) {}

  std::shared_ptr<const std::filesystem::path> file_;
  YAML::Node node_;
  std::string name_;
};

}  // namespace eigengrasp
