// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>

namespace eigengrasp::server {

/// A folder of an upload, which goes with everything in it.
class ScratchFolder {
 public:
  ScratchFolder();  ///< @throws Error where there is no room
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A sentence as the client may read it: files are named as it named them, the folder is not.
  std::string hidden_in(std::string sentence) const;

 private:
  std::filesystem::path path_;
};

}  // namespace eigengrasp::server
