// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

using OrderedJson = nlohmann::ordered_json;

/// Indented text; arrays of plain values stand on one line. @throws std::logic_error for a number that is not
/// finite.
std::string pretty_text(const OrderedJson& json);

/// Parses a whole text. @throws Error with the line where it is not JSON.
OrderedJson parse_json(std::string_view text, const std::string& name);

/// A value of a JSON text and the way to it, for errors.
class JsonView {
 public:
  JsonView(const OrderedJson& json, std::string name) : json_(&json), name_(std::move(name)) {}

  /// Member of an object, which must be there.
  JsonView at(const std::string& key) const;
  bool has(const std::string& key) const;
  /// Elements of an array.
  std::vector<JsonView> elements() const;
  /// Members of an object, in their order.
  std::vector<std::pair<std::string, JsonView>> members() const;

  std::string text() const;
  bool boolean() const;
  double number() const;
  double number_at_least(double low) const;
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  std::uint64_t natural() const;
  std::vector<std::string> texts() const;
  /// An array of numbers; of the given length where it is not negative.
  VecX numbers(int length = -1) const;
  Vec3 vec3() const { return numbers(3); }
  Vec3 unit_vec3() const;
  /// {"position": [x, y, z], "orientation": [w, x, y, z]}
  Pose pose() const;

  /// Throws Error "NAME: PATH: found VALUE, expected ..."
  [[noreturn]] void refuse(const std::string& expected) const;

 private:
  JsonView(const OrderedJson& json, std::string name, std::string path)
      : json_(&json), name_(std::move(name)), path_(std::move(path)) {}
  const OrderedJson* json_;
  std::string name_;
  std::string path_;  ///< such as grasps[3].contacts[0]
};

/// The pose as JsonView::pose reads it. Quaternions are such that writing what was read gives the same
/// digits.
OrderedJson pose_json(const Pose& X);

template <typename Derived>
OrderedJson numbers_json(const Eigen::MatrixBase<Derived>& v) {
  OrderedJson json = OrderedJson::array();
  for (Eigen::Index i = 0; i < v.size(); ++i) json.push_back(v[i]);
  return json;
}

}  // namespace eigengrasp
