// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace eigengrasp::server {

/// What clients may ask of the server.
struct ServerLimits {
  int connections = 256;    ///< HTTP and WebSocket together; more are closed at once
  int clients = 32;         ///< WebSockets; more are answered with 503
  int plans = 4;            ///< that run at a time
  int online_sessions = 8;  ///< online planners at a time
  int uploads = 32;         ///< objects and hands that are kept
  std::int64_t upload_bytes = std::int64_t{64} << 20;
  std::int64_t upload_triangles = 1'000'000;
  std::int64_t unpacked_bytes = std::int64_t{256} << 20;  ///< of the files in a hand's archive together
  int archive_entries = 2000;
  std::int64_t message_bytes = 65536;    ///< of a WebSocket message
  double messages_per_second = 2000.0;   ///< of a client
  std::int64_t queued_bytes = 16 << 20;  ///< that wait for a slow client; beyond it is dropped
  double slow_seconds = 10.0;            ///< a client that reads nothing for so long is dropped
  double silent_seconds = 30.0;          ///< a client that answers no ping for so long is dropped
  double hello_seconds = 10.0;           ///< a client that does not say hello for so long is dropped
};

struct ServerOptions {
  std::string bind = "127.0.0.1";
  int port = 8080;  ///< 0: any that is free
  std::string token;
  std::string hand;             ///< the app begins with; empty: its own choice
  std::string object;           ///< name, or a file that is loaded at start
  std::filesystem::path app;    ///< folder of the built web app; empty: looked for
  std::optional<int> udp_port;  ///< for trackers, on loopback
  std::filesystem::path logs;   ///< folder of session logs; empty: none are kept
  int threads = 0;              ///< of a plan; 0: all
  ServerLimits limits;

  /// All violations as sentences: option, value, bound, way out. Empty: the options are sound.
  std::vector<std::string> validate() const;
};

}  // namespace eigengrasp::server
