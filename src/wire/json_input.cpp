// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "wire/json_input.hpp"

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "wire/schema_checker.hpp"

namespace eigengrasp::wire {

namespace {

/// Deepest nesting of arrays and objects, before anything is built of the text.
int depth_of(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

const SchemaChecker& checker() {
  static const SchemaChecker the_checker(schema_text());
  return the_checker;
}

/// What sentences call the value: its type where it has one.
std::string name_of_message(const nlohmann::json& value) {
  if (value.is_object())
    if (const auto type = value.find("type"); type != value.end() && type->is_string())
      if (const auto& text = type->get_ref<const std::string&>();
          !text.empty() && text.size() <= 20 &&
          std::all_of(text.begin(), text.end(), [](char c) { return c == '.' || (c >= 'a' && c <= 'z'); }))
        return text;
  return "message";
}

}  // namespace

nlohmann::json checked_json(std::string_view text, std::string_view definition, const TextLimits& limits) {
  if (text.size() > limits.bytes)
    fail("message: found {} bytes, expected at most {}", text.size(), limits.bytes);
  if (const int depth = depth_of(text); depth > limits.depth)
    fail("message: found arrays and objects {} deep, expected at most {}", depth, limits.depth);
  nlohmann::json value;
  try {
    value = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    fail("message: found no JSON from byte {} on, expected one object of JSON in UTF-8", e.byte);
  } catch (const nlohmann::json::exception&) {
    fail("message: found a number that is too large, expected numbers of double precision");
  }
  checker().require(value, definition, name_of_message(value));
  return value;
}

void require_schema(std::string_view text, std::string_view definition, const TextLimits& limits) {
  checked_json(text, definition, limits);
}

}  // namespace eigengrasp::wire
