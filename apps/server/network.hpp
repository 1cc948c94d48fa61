// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/client.hpp"
#include "server/http_types.hpp"
#include "server/server_options.hpp"

namespace eigengrasp::server {

/// What the network asks of the program.
struct NetworkHandlers {
  /// Looks at a request before its body is read; an answer refuses it. On an I/O thread: must not block.
  std::function<std::optional<HttpReply>(const HttpRequest&)> admit;
  /// Answers a request, on a worker thread.
  std::function<HttpReply(const HttpRequest&)> answer;
  /// Whether requests of this path may carry a body of limits.upload_bytes; others have no body.
  std::function<bool(const HttpRequest&)> takes_body;
  /// A WebSocket at /ws that was admitted. On an I/O thread.
  std::function<std::shared_ptr<ClientHandler>(std::shared_ptr<Client>)> connected;
  /// A datagram. On an I/O thread.
  std::function<void(std::string_view)> datagram;
};

/// HTTP, WebSockets and datagrams: everything that knows sockets. Each connection has a strand of its own.
class Network {
 public:
  /// Opens the ports. @throws Error for an address that is not this machine's, or a port in use.
  Network(const ServerOptions& options, NetworkHandlers handlers);
  ~Network();

  int port() const;
  /// 0 where there is none.
  int udp_port() const;
  /// Serves until SIGINT, SIGTERM or stop(); then closes the WebSockets (code 1001) and returns.
  void run();
  /// From any thread.
  void stop();

 private:
  class Work;
  std::shared_ptr<Work> work_;
};

}  // namespace eigengrasp::server
