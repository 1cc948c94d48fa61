// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string_view>
#include <variant>
#include <vector>

#include "eigengrasp/wire/messages.hpp"

namespace eigengrasp::wire {

/// One line of a session log: what came in or went out, t seconds after the log began.
struct LogLine {
  double t = 0.0;
  std::variant<ClientMessage, ServerMessage> message;
};

/// Writes a session log: lines of JSON, see docs/wire-protocol.md. From any thread. What was written is on
/// disk after at most a second of messages, and when the writer goes.
class SessionLogWriter {
 public:
  /// @param max_bytes beyond which nothing more is written
  /// @throws Error where the file cannot be made.
  explicit SessionLogWriter(const std::filesystem::path& file,
                            std::int64_t max_bytes = std::int64_t{256} << 20);

  /// A hello is kept without its token.
  void write_in(const ClientMessage& message);
  /// @param text of a server message, as it was sent
  void write_out(std::string_view text);

 private:
  void write(const char* direction, std::string_view text);
  double seconds() const;

  std::mutex mutex_;
  std::ofstream out_;
  std::int64_t left_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double flushed_ = 0.0;
};

/// Reads a log whole. A last line without its newline, as a killed server leaves it, is left out.
/// @throws Error "FILE:LINE: ..." with the JSON path, what was found and what was expected.
std::vector<LogLine> read_session_log(const std::filesystem::path& file);

}  // namespace eigengrasp::wire
