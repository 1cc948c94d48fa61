// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>

namespace eigengrasp {

/// Holds a folder for one writer or several readers, of all programs, until it goes. The system lets go of it
/// when the program ends in whichever way.
class FolderLock {
 public:
  /// @throws Error "PLACE: is in use ..." where another holds it for longer than some seconds
  FolderLock(const std::filesystem::path& folder, bool writing, double seconds, const std::string& place);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace eigengrasp
