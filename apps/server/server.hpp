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
  std::string url;   ///< of the app, with the address that a browser on this machine takes
  int udp_port = 0;  ///< 0: none
  bool app = false;  ///< whether there is a web app to be shown
};

/// Serves until SIGINT or SIGTERM: the web app, planning, online planning.
/// @param files keeps what is made of meshes; none: all is made anew
/// @param ready called once, when the ports are open
/// @throws Error, one sentence, for options that are not sound, a port in use, a folder without an app,
/// models that cannot be read.
void serve(const ServerOptions& options, std::shared_ptr<PreparationCache> files,
           const std::function<void(const ServerAddress&)>& ready);

}  // namespace eigengrasp::server
