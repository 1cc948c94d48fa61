// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/file_bounds.hpp"

#include <algorithm>

namespace eigengrasp {

namespace fs = std::filesystem;

bool is_within(const fs::path& file, const fs::path& folder) {
  if (folder.empty()) return true;
  std::error_code ec;
  const fs::path bounds = fs::canonical(folder, ec);
  if (ec) return false;
  const fs::path inner = fs::weakly_canonical(file, ec);
  if (ec) return false;
  return std::mismatch(bounds.begin(), bounds.end(), inner.begin(), inner.end()).first == bounds.end();
}

}  // namespace eigengrasp
