// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include "server/network_context.hpp"

namespace eigengrasp::server {

/// Serves a connection that was accepted. @param ticket kept as long as it is open
void begin_http(NetworkContext& context, boost::asio::ip::tcp::socket socket, std::shared_ptr<void> ticket);

}  // namespace eigengrasp::server
