// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/file_sum.hpp"

#include <fstream>
#include <sstream>
#include <string>

#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"

namespace eigengrasp {

namespace {

const char* const kTitle = "eigengrasp-shape-index";
constexpr int version = 1;

std::filesystem::path sum_of(const std::filesystem::path& file) {
  return file.string() + ".sum";
}

/// The hash of the hashes of pieces: an index is too large to be read at once.
std::string hash_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("{}: cannot be read, expected a shape index", file.string());
  std::string piece(std::size_t{1} << 24, '\0');
  std::string hashes;
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())) || stream.gcount() > 0)
    hashes += content_hash(std::string_view(piece).substr(0, static_cast<std::size_t>(stream.gcount())));
  return content_hash(hashes);
}

}  // namespace

void write_file_sum(const std::filesystem::path& file, std::size_t dimension) {
  write_file_atomically(sum_of(file),
                        fmt::format("{} {} {} {}\n", kTitle, version, dimension, hash_of_file(file)));
}

std::size_t check_file_sum(const std::filesystem::path& file) {
  std::istringstream text(read_text_file(sum_of(file)));
  std::string title, hash;
  int found_version = 0;
  std::size_t dimension = 0;
  text >> title >> found_version >> dimension >> hash;
  if (!text || title != kTitle || found_version != version || dimension == 0)
    fail("{}: is no sum of a shape index of version {}; make the index again", sum_of(file).string(),
         version);
  if (hash_of_file(file) != hash)
    fail("{}: is damaged or cut (its sum differs from that in {}); make the index again", file.string(),
         sum_of(file).filename().string());
  return dimension;
}

}  // namespace eigengrasp
