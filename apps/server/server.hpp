// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "eigengrasp/geometry/preparation_cache.hpp"
#include "server/server_options.hpp"

namespace eigengrasp::server {

/// What a server says of itself when it is ready.
struct ServerAddress {
  int port = 0;      ///< of HTTP and WebSocket
  std::string url;   ///< of the app, with the address that a browser on this machine takes
  int udp_port = 0;  ///< 0: none
  bool app = false;  ///< whether there is a web app to be shown
};

/// Called once, when the ports are open; stop ends the server, from any thread; later it does nothing.
using WhenReady = std::function<void(const ServerAddress&, const std::function<void()>& stop)>;

/// Serves until SIGINT, SIGTERM or a stop: the web app, planning, online planning.
/// @param files keeps what is made of meshes; none: all is made anew
/// @throws Error, one sentence, for options that are not sound, a port in use, a folder without an app,
/// models that cannot be read.
void serve(const ServerOptions& options, std::shared_ptr<PreparationCache> files, const WhenReady& ready);

}  // namespace eigengrasp::server
