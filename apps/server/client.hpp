// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

namespace eigengrasp::server {

using Clock = std::chrono::steady_clock;

/// What becomes of a message that still waits when a newer one of the same kind comes.
enum class Kind {
  lasting,    ///< is sent all the same
  view,       ///< the newer one takes its place
  progress,   ///< likewise
  milestone,  ///< likewise
};

/// The server's end of a WebSocket. All functions may be called from any thread and return at once.
class Client {
 public:
  virtual ~Client() = default;
  virtual void send(std::string text, Kind kind) = 0;
  /// Closes after what waits was sent. @param code of RFC 6455, such as 1008  @param reason at most 123 bytes
  virtual void close(int code, std::string reason) = 0;
};

/// What takes the messages of a client, one at a time. Must not block.
class ClientHandler {
 public:
  virtual ~ClientHandler() = default;
  virtual void on_text(std::string_view text, Clock::time_point arrived) = 0;
  virtual void on_binary() = 0;
  /// The last call.
  virtual void on_closed() = 0;
  /// Whether the client has said hello.
  virtual bool is_known() const = 0;
};

}  // namespace eigengrasp::server
