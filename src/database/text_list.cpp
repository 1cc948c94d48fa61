// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/text_list.hpp"

#include <nlohmann/json.hpp>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

std::string format_texts(const std::vector<std::string>& texts) {
  return nlohmann::json(texts).dump();
}

std::vector<std::string> parse_texts(std::string_view text, const std::string& where) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  const auto is_text = [](const nlohmann::json& t) { return t.is_string(); };
  if (!json.is_array() || !std::all_of(json.begin(), json.end(), is_text))
    fail("{}: found '{}', expected a list of texts", where, text.substr(0, 60));
  return json.get<std::vector<std::string>>();
}

}  // namespace eigengrasp
