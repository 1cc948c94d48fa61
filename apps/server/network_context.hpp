// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "server/counter.hpp"
#include "server/network.hpp"

namespace eigengrasp::server {

/// A WebSocket as the network sees it.
class OpenClient : public Client {
 public:
  /// After the network stopped: tells the handler that it is over.
  virtual void end_now() = 0;
};

/// What the connections of a network share. It outlives them: they end with the io_context.
struct NetworkContext {
  ServerOptions options;
  NetworkHandlers handlers;
  std::shared_ptr<Counter> connections = std::make_shared<Counter>();
  std::shared_ptr<Counter> clients = std::make_shared<Counter>();
  std::shared_ptr<Counter> uploads = std::make_shared<Counter>();
  std::mutex mutex;
  std::vector<std::weak_ptr<OpenClient>> open_clients;
  bool stopping = false;
  boost::asio::io_context io{2};
  boost::asio::thread_pool workers{2};

  NetworkContext(const ServerOptions& o, NetworkHandlers h) : options(o), handlers(std::move(h)) {}
};

}  // namespace eigengrasp::server
