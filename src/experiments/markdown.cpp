// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "experiments/markdown.hpp"

namespace eigengrasp {

namespace {

std::string line_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += ' ';
    for (const char c : cell) line += c == '|' ? std::string("\\|") : std::string(1, c);
    line += " |";
  }
  return line + '\n';
}

}  // namespace

std::string markdown_table(const std::vector<std::string>& headings,
                           const std::vector<std::vector<std::string>>& rows) {
  std::string text = line_of(headings) + '|';
  for (std::size_t i = 0; i < headings.size(); ++i) text += "---|";
  text += '\n';
  for (const auto& row : rows) text += line_of(row);
  return text;
}

}  // namespace eigengrasp
