// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/archive.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>

#include "eigengrasp/core/error.hpp"
#include "server/upload_name.hpp"

namespace eigengrasp::server {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestPath = 240;

struct Release {
  void operator()(struct archive* reader) const { archive_read_free(reader); }
};
using Reader = std::unique_ptr<struct archive, Release>;

/// A path as it may stand in a sentence.
std::string shown(std::string path) {
  for (char& c : path)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return path.size() > 80 ? path.substr(0, 80) + "..." : path;
}

std::string complaint_of(struct archive* reader) {
  const char* text = archive_error_string(reader);
  return shown(text == nullptr ? "it is damaged" : text);
}

Reader open_archive(const std::string& bytes) {
  Reader reader(archive_read_new());
  if (!reader) throw std::bad_alloc();
  archive_read_support_filter_gzip(reader.get());
  archive_read_support_format_tar(reader.get());
  archive_read_support_format_zip(reader.get());
  if (archive_read_open_memory(reader.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    fail("the file is no archive that can be read ({}), expected a .zip, .tar or .tar.gz",
         complaint_of(reader.get()));
  return reader;
}

std::string path_of(struct archive_entry* entry) {
  const char* path = archive_entry_pathname_utf8(entry);
  if (path == nullptr) path = archive_entry_pathname(entry);
  if (path == nullptr || *path == '\0') fail("an entry of the archive has no path that can be read");
  return path;
}

/// The path without "." parts. @throws Error where it could lead out of the folder
fs::path safe_path(const std::string& text) {
  if (text.size() > kLongestPath)
    fail("the archive's entry {} has a path of {} characters, expected at most {}", shown(text), text.size(),
         kLongestPath);
  const bool odd = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\' || c == ':';
  });
  if (odd)
    fail("the archive's entry {} has a backslash, a colon or a control character in its path, expected none",
         shown(text));
  const fs::path path(text);
  if (path.is_absolute())
    fail("the archive's entry {} has an absolute path, expected paths below the hand's folder", shown(text));
  fs::path safe;
  for (const fs::path& part : path) {
    if (part == "..")
      fail("the archive's entry {} leads out of the archive (..), expected paths below the hand's folder",
           shown(text));
    if (!part.empty() && part != ".") safe /= part;
  }
  return safe;
}

void require_plain(struct archive_entry* entry, const std::string& path) {
  const auto type = archive_entry_filetype(entry);
  const bool link =
      archive_entry_hardlink(entry) != nullptr || archive_entry_symlink(entry) != nullptr || type == AE_IFLNK;
  if (link)
    fail("the archive's entry {} is a link, expected regular files; pack the files themselves", shown(path));
  if (type != AE_IFREG && type != AE_IFDIR)
    fail("the archive's entry {} is no regular file (a device, pipe or socket), expected files and folders",
         shown(path));
}

bool is_left_out(const fs::path& path, const ArchiveLimits& limits) {
  for (const fs::path& part : path)
    if (part == "__MACOSX" || part.native().starts_with('.')) return true;
  const auto& known = limits.endings;
  return !known.empty() &&
         std::find(known.begin(), known.end(), ending_of(path.filename().string())) == known.end();
}

class Unpacking {
 public:
  Unpacking(const std::string& bytes, fs::path folder, const ArchiveLimits& limits)
      : reader_(open_archive(bytes)), folder_(std::move(folder)), limits_(limits) {}

  void run() {
    for (int count = 0; struct archive_entry* entry = next();) {
      if (++count > limits_.entries)
        fail("the archive has more than {} files and folders, the most that are taken", limits_.entries);
      take(entry);
    }
  }

 private:
  struct archive_entry* next() {
    struct archive_entry* entry = nullptr;
    const int result = archive_read_next_header(reader_.get(), &entry);
    if (result == ARCHIVE_EOF) return nullptr;
    if (result != ARCHIVE_OK && result != ARCHIVE_WARN)
      fail("the archive cannot be read ({}), expected a .zip, .tar or .tar.gz that is whole",
           complaint_of(reader_.get()));
    return entry;
  }

  void take(struct archive_entry* entry) {
    const std::string path = path_of(entry);
    const fs::path safe = safe_path(path);
    require_plain(entry, path);
    if (safe.empty() || archive_entry_filetype(entry) == AE_IFDIR) return;  // files make their folders
    if (is_left_out(safe, limits_)) return copy(path, nullptr);
    const fs::path file = folder_ / safe;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error || fs::exists(fs::symlink_status(file, error)))
      fail("the archive's entry {} is there twice, or is a file and a folder, expected each path once",
           shown(path));
    std::ofstream out(file, std::ios::binary);
    copy(path, &out);
    out.close();
    if (!out) fail("the server has no room for the archive's entry {}; is its disk full?", shown(path));
  }

  /// All of an entry's bytes, counted whether they are kept or not: a bomb is one either way.
  void copy(const std::string& path, std::ofstream* out) {
    while (true) {
      const la_ssize_t got = archive_read_data(reader_.get(), buffer_.data(), buffer_.size());
      if (got == 0) return;
      if (got < 0)
        fail(
            "the archive's entry {} cannot be read ({}), expected an archive that is whole and not encrypted",
            shown(path), complaint_of(reader_.get()));
      unpacked_ += got;
      if (unpacked_ > limits_.unpacked_bytes)
        fail("the archive's files are larger than {} bytes together, the most that are taken",
             limits_.unpacked_bytes);
      if (out != nullptr) out->write(buffer_.data(), static_cast<std::streamsize>(got));
    }
  }

  Reader reader_;
  fs::path folder_;
  const ArchiveLimits& limits_;
  std::int64_t unpacked_ = 0;
  std::vector<char> buffer_ = std::vector<char>(std::size_t{1} << 16);
};

}  // namespace

void unpack_archive(const std::string& bytes, const fs::path& folder, const ArchiveLimits& limits) {
  Unpacking(bytes, folder, limits).run();
}

}  // namespace eigengrasp::server
