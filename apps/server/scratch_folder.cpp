// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/scratch_folder.hpp"

namespace eigengrasp::server {

namespace {

std::string without(std::string text, const std::string& part, const std::string& instead) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += instead.size())
    text.replace(at, part.size(), instead);
  return text;
}

}  // namespace

std::string ScratchFolder::hidden_in(std::string sentence) const {
  return without(without(std::move(sentence), path().string() + "/", ""), path().string(), "the archive");
}

}  // namespace eigengrasp::server
