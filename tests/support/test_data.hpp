// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace eigengrasp::testing {

/// A file or folder of the repository.
inline std::filesystem::path source_path(const std::filesystem::path& relative) {
  return std::filesystem::path(EIGENGRASP_SOURCE_DIR) / relative;
}

/// A file or folder of the test data that is not part of the repository: $EIGENGRASP_DATA, by default
/// ~/.cache/eigengrasp-data. Empty where it is absent.
inline std::filesystem::path test_data(const std::filesystem::path& relative) {
  std::filesystem::path root;
  if (const char* folder = std::getenv("EIGENGRASP_DATA")) {
    root = folder;
  } else if (const char* home = std::getenv("HOME")) {
    root = std::filesystem::path(home) / ".cache" / "eigengrasp-data";
  }
  const auto path = root / relative;
  return std::filesystem::exists(path) ? path : std::filesystem::path();
}

}  // namespace eigengrasp::testing

/// Skips the rest of a test, loudly, where a path from test_data() is absent.
#define EIGENGRASP_REQUIRE_DATA(path) \
  if ((path).empty()) GTEST_SKIP() << "needs the test data (set EIGENGRASP_DATA): " #path
