// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "wire/enum_names.hpp"
#include "wire/fields.hpp"

namespace eigengrasp::wire {

template <typename T>
void read_value(const nlohmann::json& json, T& value);
template <typename T>
nlohmann::ordered_json written_value(const T& value);

/// Reads members of a JSON object that the schema holds sound; those that are not there keep their values.
class FieldReader {
 public:
  explicit FieldReader(const nlohmann::json& json) : json_(json) {}
  template <typename T>
  void operator()(const char* name, T& member) {
    if (const auto found = json_.find(name); found != json_.end()) read_value(*found, member);
  }

 private:
  const nlohmann::json& json_;
};

/// Writes members to a JSON object, in their order, but for optional ones without a value.
class FieldWriter {
 public:
  explicit FieldWriter(nlohmann::ordered_json& json) : json_(json) {}
  template <typename T>
  void operator()(const char* name, const T& member) {
    json_[name] = written_value(member);
  }
  template <typename T>
  void operator()(const char* name, const std::optional<T>& member) {
    if (member) json_[name] = written_value(*member);
  }

 private:
  nlohmann::ordered_json& json_;
};

template <typename T>
struct IsSequence : std::false_type {};
template <typename T>
struct IsSequence<std::vector<T>> : std::true_type {};
template <typename T, std::size_t n>
struct IsSequence<std::array<T, n>> : std::true_type {};
template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <typename T>
void read_value(const nlohmann::json& json, T& value) {
  if constexpr (IsOptional<T>::value) {
    value = typename T::value_type{};  // clang 14 finds no emplace() for structures inside of structures
    read_value(json, *value);
  } else if constexpr (std::is_enum_v<T>) {
    value = value_of<T>(json.get_ref<const std::string&>());
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    value = json.get<T>();
  } else if constexpr (IsSequence<T>::value) {
    if constexpr (requires { value.resize(json.size()); }) value.resize(json.size());
    for (std::size_t i = 0; i < value.size(); ++i) read_value(json[i], value[i]);
  } else {
    FieldReader reader(json);
    fields(reader, value);
  }
}

template <typename T>
nlohmann::ordered_json written_value(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) throw std::logic_error("a number that is not finite cannot be written");
    return value;
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else if constexpr (IsSequence<T>::value) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const auto& element : value) json.push_back(written_value(element));
    return json;
  } else {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    FieldWriter writer(json);
    fields(writer, const_cast<T&>(value));  // which the writer leaves as it is
    return json;
  }
}

}  // namespace eigengrasp::wire
