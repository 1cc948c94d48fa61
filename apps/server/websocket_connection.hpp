// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "server/network_context.hpp"

namespace eigengrasp::server {

using UpgradeRequest = boost::beast::http::request<boost::beast::http::string_body>;

/// Takes a connection over that asked for a WebSocket. It lives until either side closes.
/// @param tickets kept as long
void begin_websocket(NetworkContext& context, boost::beast::tcp_stream stream, const UpgradeRequest& request,
                     std::vector<std::shared_ptr<void>> tickets);

}  // namespace eigengrasp::server
