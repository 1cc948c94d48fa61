// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace eigengrasp {

/// The newest version of the text format that this program writes and reads.
inline constexpr int kTextStoreVersion = 1;

/// A file of a text store: a head, then records, one JSON object a line. The head says of what kind and
/// version the file is and how many records follow, so that a cut is seen wherever it is.
struct TextLines {
  nlohmann::ordered_json head;  ///< beside "eigengrasp", "version" and "records"
  std::vector<std::string> records;
};

std::string format_lines(const std::string& kind, const TextLines& lines);

/// Reads the head alone. @throws Error, one sentence with file and line, for a cut, foreign or newer file
nlohmann::ordered_json read_head(const std::filesystem::path& file, const std::string& kind);

/// Reads head and records; each is called with every record, and what it throws of nlohmann's becomes an
/// Error with file and line. @returns the head
nlohmann::ordered_json read_lines(const std::filesystem::path& file, const std::string& kind,
                                  const std::function<void(const nlohmann::ordered_json&)>& each);

/// Writes several files, each atomically; where one cannot be written the others become what they were.
void write_files(const std::vector<std::pair<std::filesystem::path, std::string>>& files);

}  // namespace eigengrasp
