// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/upload_name.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace eigengrasp::server {

std::string sound_name(const std::string& wanted, const std::string& otherwise) {
  std::string name = wanted.substr(0, 48);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '_';
  if (name.empty() || name.front() == '.') name.insert(0, otherwise);
  return name;
}

std::string ending_of(const std::string& file_name) {
  std::string ending = std::filesystem::path(file_name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace eigengrasp::server
