// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace eigengrasp::testing {

/// What stands in an archive.
struct Entry {
  std::string path;
  std::string content = {};
  decltype(AE_IFREG) type = AE_IFREG;
  std::string link = {};
};

enum class ArchiveKind { tar, tar_gz, zip };

/// An archive as an honest or hostile program would write it.
inline std::string packed(const std::vector<Entry>& entries, ArchiveKind kind = ArchiveKind::tar) {
  std::string bytes(std::size_t{32} << 20, '\0');
  std::size_t used = 0;
  struct archive* writer = archive_write_new();
  if (kind == ArchiveKind::zip)
    archive_write_set_format_zip(writer);
  else
    archive_write_set_format_pax_restricted(writer);
  if (kind == ArchiveKind::tar_gz) archive_write_add_filter_gzip(writer);
  archive_write_open_memory(writer, bytes.data(), bytes.size(), &used);
  for (const Entry& e : entries) {
    struct archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, e.path.c_str());
    archive_entry_set_filetype(entry, e.type);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, static_cast<la_int64_t>(e.content.size()));
    if (e.type == AE_IFLNK)
      archive_entry_set_symlink(entry, e.link.c_str());
    else if (!e.link.empty())
      archive_entry_set_hardlink(entry, e.link.c_str());
    EXPECT_EQ(archive_write_header(writer, entry), ARCHIVE_OK) << e.path;
    if (!e.content.empty()) archive_write_data(writer, e.content.data(), e.content.size());
    archive_entry_free(entry);
  }
  archive_write_close(writer);
  archive_write_free(writer);
  bytes.resize(used);
  return bytes;
}

}  // namespace eigengrasp::testing
