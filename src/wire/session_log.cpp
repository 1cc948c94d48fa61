// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/wire/session_log.hpp"

#include <fmt/format.h>

#include <string>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/wire/wire_text.hpp"
#include "wire/json_input.hpp"

namespace eigengrasp::wire {

SessionLogWriter::SessionLogWriter(const std::filesystem::path& file, std::int64_t max_bytes)
    : out_(file, std::ios::binary | std::ios::trunc), left_(max_bytes) {
  if (!out_) fail("{}: the session log cannot be made; is the folder there and writable?", file.string());
}

double SessionLogWriter::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void SessionLogWriter::write_in(const ClientMessage& message) {
  ClientMessage kept = message;
  if (auto* hello = std::get_if<Hello>(&kept)) hello->token.reset();
  write("in", to_text(kept));
}

void SessionLogWriter::write_out(std::string_view text) {
  write("out", text);
}

void SessionLogWriter::write(const char* direction, std::string_view text) {
  const std::lock_guard lock(mutex_);
  const double t = seconds();
  const std::string line = fmt::format("{{\"t\":{:.6f},\"{}\":{}}}\n", t, direction, text);
  if (static_cast<std::int64_t>(line.size()) > left_) {
    left_ = 0;
    return;
  }
  left_ -= static_cast<std::int64_t>(line.size());
  out_ << line;
  if (t < flushed_ + 1.0) return;
  out_.flush();
  flushed_ = t;
}

namespace {

LogLine read_line(std::string_view text, const std::filesystem::path& file, int number) {
  try {
    const nlohmann::json json = checked_json(text, "LogLine", kServerText);
    LogLine line{json["t"].get<double>(), ClientMessage{}};
    if (json.contains("in"))
      line.message = parse_client_message(json["in"].dump(), kServerText);
    else
      line.message = parse_server_message(json["out"].dump(), kServerText);
    return line;
  } catch (const Error& e) {
    fail_at(file, number, "{}", e.what());
  }
}

}  // namespace

std::vector<LogLine> read_session_log(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  std::vector<LogLine> lines;
  int number = 0;
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(read_line(std::string_view(text).substr(begin, end - begin), file, ++number));
  return lines;
}

}  // namespace eigengrasp::wire
