// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/scratch_folder.hpp"

#include <stdlib.h>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp::server {

namespace fs = std::filesystem;

namespace {

std::string without(std::string text, const std::string& part, const std::string& instead) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += instead.size())
    text.replace(at, part.size(), instead);
  return text;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "eigengrasp-upload-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) fail("the server has no room for uploads; is its disk full?");
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string ScratchFolder::hidden_in(std::string sentence) const {
  return without(without(std::move(sentence), path_.string() + "/", ""), path_.string(), "the archive");
}

}  // namespace eigengrasp::server
