// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "wire/schema_checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp::wire {

using nlohmann::json;

/// Where a value stands: a chain from the value to the root, made into text only for a sentence.
struct SchemaChecker::Place {
  const std::string* name = nullptr;
  const Place* parent = nullptr;
  const std::string* member = nullptr;
  std::size_t index = 0;

  Place of_member(const std::string& key) const { return {name, this, &key, 0}; }
  Place of_element(std::size_t i) const { return {name, this, nullptr, i}; }
  std::string path() const {
    if (parent == nullptr) return "";
    const std::string before = parent->path();
    if (member == nullptr) return fmt::format("{}[{}]", before, index);
    return before.empty() ? *member : before + '.' + *member;
  }
  [[noreturn]] void refuse(const std::string& sentence) const {
    const std::string where = path();
    fail("{}: {}{}{}", *name, where, where.empty() ? "" : ": ", sentence);
  }
};

namespace {

std::string cut(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  text.resize(most - 3);
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
  if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xC0U) text.pop_back();
  return text + "...";
}

std::string shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  return cut(value.dump(-1, ' ', false, json::error_handler_t::replace), 48);
}

/// Whether a number is an integer as JSON Schema sees it: 1.0 is one.
bool is_integral(const json& value) {
  if (value.is_number_integer()) return true;
  if (!value.is_number_float()) return false;
  const double x = value.get<double>();
  return std::isfinite(x) && x == std::floor(x) && std::abs(x) <= 9007199254740992.0;
}

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return is_integral(value);
  return value.is_number();
}

/// Code points of a UTF-8 text.
std::size_t length_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

bool within_bounds(const json& value, const json& schema) {
  if (value.is_number()) {
    const double x = value.get<double>();
    return (!schema.contains("minimum") || x >= schema["minimum"].get<double>()) &&
           (!schema.contains("maximum") || x <= schema["maximum"].get<double>());
  }
  if (value.is_string()) {
    const std::size_t length = length_of(value.get_ref<const std::string&>());
    return length >= schema.value("minLength", std::size_t{0}) &&
           length <= schema.value("maxLength", static_cast<std::size_t>(-1));
  }
  const std::string least = value.is_array() ? "minItems" : "minProperties";
  const std::string most = value.is_array() ? "maxItems" : "maxProperties";
  if (!value.is_array() && !value.is_object()) return true;
  return value.size() >= schema.value(least, std::size_t{0}) &&
         value.size() <= schema.value(most, static_cast<std::size_t>(-1));
}

std::string joined(const json& values) {
  std::string all;
  for (const json& v : values) all += (all.empty() ? "" : ", ") + v.dump();
  return all;
}

/// Refuses keywords that would be passed over.
void require_known_keywords(const json& schema) {
  static const std::set<std::string> known = {
      "$ref",         "type",          "const", "enum",     "minimum",    "maximum",
      "minLength",    "maxLength",     "items", "minItems", "maxItems",   "required",
      "description",  "minProperties", "oneOf", "default",  "properties", "additionalProperties",
      "maxProperties"};
  for (const auto& [key, value] : schema.items()) {
    if (!known.contains(key))
      throw std::logic_error("the schema has the keyword " + key + ", which is not known");
    if (key == "properties")
      for (const auto& [name, member] : value.items()) require_known_keywords(member);
    if (key == "items") require_known_keywords(value);
    if (key == "oneOf")
      for (const json& variant : value) require_known_keywords(variant);
  }
}

}  // namespace

SchemaChecker::SchemaChecker(std::string_view schema) : schema_(json::parse(schema)) {
  for (const auto& [name, definition] : schema_.at("$defs").items()) require_known_keywords(definition);
}

const json& SchemaChecker::resolved(const json& schema) const {
  const json* at = &schema;
  constexpr std::string_view prefix = "#/$defs/";
  while (at->contains("$ref"))
    at = &schema_["$defs"].at(at->at("$ref").get<std::string>().substr(prefix.size()));
  return *at;
}

void SchemaChecker::require(const json& value, std::string_view definition, const std::string& name) const {
  const auto found = schema_["$defs"].find(definition);
  if (found == schema_["$defs"].end()) fail("the schema has no entry '{}'", definition);
  check(value, *found, Place{.name = &name});
}

std::string SchemaChecker::expectation(const json& schema) const {
  if (schema.contains("const")) return schema["const"].dump();
  if (schema.contains("enum")) return "one of " + joined(schema["enum"]);
  const std::string type = schema.value("type", "a value");
  const auto range = [&](const char* low, const char* high) {
    const bool one = schema.contains(low) && schema.contains(high) && schema[low] == schema[high];
    if (one) return schema[low].dump();
    if (!schema.contains(high)) return "at least " + (schema.contains(low) ? schema[low] : json(0)).dump();
    if (!schema.contains(low)) return "at most " + schema[high].dump();
    return schema[low].dump() + " to " + schema[high].dump();
  };
  if (type == "number" || type == "integer")
    return fmt::format("{} from {}", type == "number" ? "a number" : "an integer",
                       range("minimum", "maximum"));
  if (type == "string") return fmt::format("a text of {} characters", range("minLength", "maxLength"));
  if (type == "array") return fmt::format("an array of {} elements", range("minItems", "maxItems"));
  if (type == "boolean") return "true or false";
  return schema.contains("minProperties")
             ? fmt::format("an object of {} members", range("minProperties", "maxProperties"))
             : "an object";
}

void SchemaChecker::check(const json& value, const json& reference, const Place& place) const {
  const json& schema = resolved(reference);
  if (schema.contains("oneOf")) return check_variants(value, schema, place);
  const auto refuse = [&] {
    place.refuse(fmt::format("found {}, expected {}", shown(value), expectation(schema)));
  };
  if (schema.contains("const") && value != schema["const"]) refuse();
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    refuse();
  if (schema.contains("type") && !has_type(value, schema["type"].get_ref<const std::string&>())) refuse();
  if (!within_bounds(value, schema)) refuse();
  if (value.is_object()) check_object(value, schema, place);
  if (value.is_array()) check_array(value, schema, place);
}

void SchemaChecker::check_object(const json& value, const json& schema, const Place& place) const {
  if (!schema.contains("properties")) return;
  const json& members = schema["properties"];
  for (const auto& [key, member] : value.items()) {
    const auto known = members.find(key);
    if (known == members.end()) {
      std::string all;
      for (const auto& [name, unused] : members.items()) all += (all.empty() ? "" : ", ") + name;
      place.refuse(fmt::format("found the member {}, expected none but {}", shown(json(key)), all));
    }
    check(member, *known, place.of_member(known.key()));
  }
  for (const json& key : schema.value("required", json::array())) {
    const std::string& name = key.get_ref<const std::string&>();
    if (!value.contains(name))
      place.of_member(name).refuse("is missing, expected " + expectation(resolved(members[name])));
  }
}

void SchemaChecker::check_array(const json& value, const json& schema, const Place& place) const {
  if (!schema.contains("items")) return;
  for (std::size_t i = 0; i < value.size(); ++i) check(value[i], schema["items"], place.of_element(i));
}

void SchemaChecker::check_variants(const json& value, const json& schema, const Place& place) const {
  if (!value.is_object()) place.refuse(fmt::format("found {}, expected an object with a type", shown(value)));
  const auto type = value.find("type");
  json all = json::array();
  for (const json& variant : schema["oneOf"]) {
    const json& one = resolved(variant);
    const json& constant = one.at("properties").at("type").at("const");
    if (type != value.end() && *type == constant) return check(value, one, place);
    all.push_back(constant);
  }
  static const std::string key = "type";
  const Place at_type = place.of_member(key);
  if (type == value.end()) at_type.refuse("is missing, expected one of " + joined(all));
  at_type.refuse(fmt::format("found {}, expected one of {}", shown(*type), joined(all)));
}

}  // namespace eigengrasp::wire
