// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace eigengrasp::server {

struct ArchiveLimits {
  std::int64_t unpacked_bytes = std::int64_t{256} << 20;  ///< of all files together
  int entries = 2000;                                     ///< files and folders
  /// In small letters with their dot; files with other endings are left out. Empty: all are taken.
  std::vector<std::string> endings = {};
};

/// Unpacks a .zip, .tar or .tar.gz that a stranger sent into a folder that is empty. It holds folders and
/// regular files only, whose paths stay in the folder; hidden files and those of macOS (__MACOSX) are left
/// out.
/// @throws Error, one sentence with the entry's path; what was unpacked before stays.
void unpack_archive(const std::string& bytes, const std::filesystem::path& folder,
                    const ArchiveLimits& limits);

}  // namespace eigengrasp::server
