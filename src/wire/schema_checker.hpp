// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace eigengrasp::wire {

/// Holds JSON values against a schema: the part of JSON Schema 2020-12 that schema/wire.schema.json uses.
/// $ref to $defs, type, const, enum, minimum, maximum, minLength, maxLength, items, minItems, maxItems,
/// properties, required, additionalProperties false, minProperties, maxProperties, and oneOf of objects that
/// a constant member "type" tells apart.
class SchemaChecker {
 public:
  /// @throws std::logic_error for a schema with other keywords.
  explicit SchemaChecker(std::string_view schema);

  /// @param name what the sentence begins with
  /// @throws Error "NAME: PATH: found ..., expected ..." for the first violation, or where $defs has no such
  /// entry.
  void require(const nlohmann::json& value, std::string_view definition, const std::string& name) const;

 private:
  struct Place;
  void check(const nlohmann::json& value, const nlohmann::json& schema, const Place& place) const;
  void check_object(const nlohmann::json& value, const nlohmann::json& schema, const Place& place) const;
  void check_array(const nlohmann::json& value, const nlohmann::json& schema, const Place& place) const;
  void check_variants(const nlohmann::json& value, const nlohmann::json& schema, const Place& place) const;
  const nlohmann::json& resolved(const nlohmann::json& schema) const;
  std::string expectation(const nlohmann::json& schema) const;

  nlohmann::json schema_;
};

}  // namespace eigengrasp::wire
