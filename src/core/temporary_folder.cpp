// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/core/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstring>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
  std::string pattern = (fs::temp_directory_path() / ("eigengrasp-" + purpose + "-XXXXXX")).string();
  if (::mkdtemp(pattern.data()) == nullptr)
    fail("no temporary folder can be made: {}; is the disk full?", std::strerror(errno));
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace eigengrasp
