// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/core/files.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {
struct FileCloser {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using FilePtr = std::unique_ptr<std::FILE, FileCloser>;
}  // namespace

std::string read_text_file(const fs::path& file) {
  std::error_code ec;
  if (fs::is_directory(file, ec)) fail("{}: is a folder, expected a file", file.string());
  const FilePtr in(std::fopen(file.c_str(), "rb"));
  if (!in) fail("{}: cannot be read ({})", file.string(), std::strerror(errno));
  std::string text;
  char buffer[1 << 16];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, in.get())) text.append(buffer, n);
  if (std::ferror(in.get())) fail("{}: cannot be read ({})", file.string(), std::strerror(errno));
  return text;
}

void write_file_atomically(const fs::path& file, std::string_view content) {
  std::error_code ec;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ec);
  static std::atomic<int> counter{0};  // threads may write the same file
  const fs::path beside = file.string() + fmt::format(".{}.{}.tmp", ::getpid(), counter++);
  FilePtr out(std::fopen(beside.c_str(), "wb"));
  if (!out) fail("{}: cannot be written ({})", file.string(), std::strerror(errno));
  const bool written = std::fwrite(content.data(), 1, content.size(), out.get()) == content.size() &&
                       std::fflush(out.get()) == 0;
  const int error = errno;
  out.reset();
  if (!written) {
    fs::remove(beside, ec);
    fail("{}: cannot be written ({})", file.string(), std::strerror(error));
  }
  fs::rename(beside, file, ec);
  if (ec) {
    const std::string reason = ec.message();
    fs::remove(beside, ec);
    fail("{}: cannot be written ({})", file.string(), reason);
  }
}

void require_writable_folder(const fs::path& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (!fs::is_directory(folder, ec)) fail("{}: the folder cannot be made; name another one", folder.string());
  const fs::path probe = folder / fmt::format(".write-test.{}.tmp", ::getpid());
  const FilePtr out(std::fopen(probe.c_str(), "wb"));
  if (!out) fail("{}: the folder cannot be written to ({})", folder.string(), std::strerror(errno));
  fs::remove(probe, ec);
}

}  // namespace eigengrasp
