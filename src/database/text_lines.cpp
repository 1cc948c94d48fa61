// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/text_lines.hpp"

#include <fstream>
#include <optional>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// What is wrong, without the library's own code in brackets.
std::string reason(const nlohmann::json::exception& e) {
  const std::string text = e.what();
  const auto end = text.find("] ");
  return (end == std::string::npos ? text : text.substr(end + 2)).substr(0, 160);
}

/// Calls a reader; what it finds wrong is told with file and line.
template <typename Read>
auto with_place(const fs::path& file, int line, Read&& read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& e) {
    fail_at(file, line, "the line is cut or damaged ({}); expected a record as in docs/grasp-store.md",
            reason(e));
  }
}

Json parse_head(const fs::path& file, const std::string& line, const std::string& kind) {
  return with_place(file, 1, [&] {
    Json head = Json::parse(line);
    const auto found = head.at("eigengrasp").get<std::string>();
    if (found != kind) fail_at(file, 1, "holds {}, expected {}", found, kind);
    const int version = head.at("version").get<int>();
    if (version > kTextStoreVersion)
      fail_at(file, 1, "is of version {}, and this program knows {} and older; use a newer eigengrasp",
              version, kTextStoreVersion);
    (void)head.at("records").get<std::size_t>();
    return head;
  });
}

}  // namespace

std::string format_lines(const std::string& kind, const TextLines& lines) {
  Json head = {{"eigengrasp", kind}, {"version", kTextStoreVersion}, {"records", lines.records.size()}};
  if (!lines.head.is_null()) head.update(lines.head);
  std::string text = head.dump() + '\n';
  for (const std::string& record : lines.records) text += record + '\n';
  return text;
}

Json read_head(const fs::path& file, const std::string& kind) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!std::getline(in, line)) fail_at(file, 0, "is empty or cannot be read, expected a head line");
  return parse_head(file, line, kind);
}

Json read_lines(const fs::path& file, const std::string& kind, const std::function<void(const Json&)>& each) {
  const std::string text = read_text_file(file);
  std::size_t begin = 0;
  int number = 0;
  const auto next = [&]() -> std::string {
    ++number;
    const auto end = text.find('\n', begin);
    if (end == std::string::npos)
      fail_at(file, number, "the {}; restore the file from a copy",
              begin < text.size() ? "line is cut in its middle" : "line is missing, the file is cut");
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    return line;
  };
  Json head = parse_head(file, next(), kind);
  const auto records = head.at("records").get<std::size_t>();
  for (std::size_t i = 0; i < records; ++i) {
    const std::string line = next();
    with_place(file, number, [&] { each(Json::parse(line)); });
  }
  if (begin < text.size())
    fail_at(file, number + 1, "there are more lines than the {} records that the head announces", records);
  return head;
}

void write_files(const std::vector<std::pair<fs::path, std::string>>& files) {
  std::vector<std::optional<std::string>> before;
  try {
    for (const auto& [file, text] : files) {
      std::optional<std::string> old;
      if (files.size() > 1 && fs::exists(file)) old = read_text_file(file);
      write_file_atomically(file, text);
      before.push_back(std::move(old));
    }
  } catch (...) {
    std::error_code ec;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i]) {
        write_file_atomically(files[i].first, *before[i]);
      } else {
        fs::remove(files[i].first, ec);
      }
    }
    throw;
  }
}

}  // namespace eigengrasp
