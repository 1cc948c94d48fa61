// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/network.hpp"

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <csignal>
#include <thread>

#include "eigengrasp/core/error.hpp"
#include "server/http_connection.hpp"
#include "server/network_context.hpp"

namespace eigengrasp::server {

namespace asio = boost::asio;
using asio::ip::tcp;
using asio::ip::udp;
using boost::system::error_code;

namespace {
constexpr std::size_t kDatagramBytes = 8192;
constexpr auto kFarewell = std::chrono::milliseconds(500);  ///< that WebSockets have to close
constexpr int kIoThreads = 2;
}  // namespace

class Network::Work {
 public:
  Work(const ServerOptions& options, NetworkHandlers handlers) : context_(options, std::move(handlers)) {
    listen();
    if (options.udp_port) listen_for_datagrams(*options.udp_port);
    signals_.add(SIGINT);
    signals_.add(SIGTERM);
    signals_.async_wait([this](error_code error, int) {
      if (!error) begin_to_stop();
    });
    accept_next();
    if (datagrams_.is_open()) receive_next();
  }

  ~Work() { context_.workers.join(); }

  void run() {
    std::vector<std::thread> threads;
    for (int i = 1; i < kIoThreads; ++i) threads.emplace_back([this] { context_.io.run(); });
    context_.io.run();
    for (std::thread& thread : threads) thread.join();
    context_.workers.join();
    for (const auto& client : open_clients()) client->end_now();
  }

  void stop() {
    asio::post(strand_, [this] { begin_to_stop(); });
  }

  int port() const { return port_; }
  int udp_port() const { return udp_port_; }

 private:
  void listen() {
    const ServerOptions& options = context_.options;
    error_code error;
    const std::string name = options.bind == "localhost" ? "127.0.0.1" : options.bind;
    const auto address = asio::ip::make_address(name, error);
    if (error) fail("--bind is '{}', expected an IP address such as 127.0.0.1 or 0.0.0.0", options.bind);
    const tcp::endpoint endpoint(address, static_cast<unsigned short>(options.port));
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error == asio::error::address_in_use)
      fail("port {} of {} is in use by another program; end it, or choose another with --port (0: any)",
           options.port, options.bind);
    if (error)
      fail("port {} of {} cannot be opened ({}); is the address this machine's, and the port above 1023?",
           options.port, options.bind, error.message());
    port_ = acceptor_.local_endpoint().port();
  }

  void listen_for_datagrams(int port) {
    error_code error;
    const udp::endpoint endpoint(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
    datagrams_.open(endpoint.protocol(), error);
    if (!error) datagrams_.bind(endpoint, error);
    if (error)
      fail("UDP port {} cannot be opened ({}); choose another with --udp (0: any)", port, error.message());
    udp_port_ = datagrams_.local_endpoint().port();
  }

  void accept_next() {
    acceptor_.async_accept(asio::make_strand(context_.io), [this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
      if (error) return accept_later();  // such as no more files
      socket.set_option(tcp::no_delay(true), error);
      if (auto ticket = Counter::take(context_.connections, context_.options.limits.connections))
        begin_http(context_, std::move(socket), std::move(ticket));
      accept_next();
    });
  }

  void accept_later() {
    timer_.expires_after(std::chrono::milliseconds(100));
    timer_.async_wait([this](error_code error) {
      if (!error) accept_next();
    });
  }

  void receive_next() {
    datagrams_.async_receive_from(asio::buffer(datagram_), sender_,
                                  [this](error_code error, std::size_t size) {
                                    if (error == asio::error::operation_aborted || !datagrams_.is_open())
                                      return;
                                    if (!error && size < datagram_.size())
                                      context_.handlers.datagram({datagram_.data(), size});
                                    receive_next();
                                  });
  }

  std::vector<std::shared_ptr<OpenClient>> open_clients() {
    const std::lock_guard lock(context_.mutex);
    std::vector<std::shared_ptr<OpenClient>> clients;
    for (const auto& client : context_.open_clients)
      if (auto open = client.lock()) clients.push_back(std::move(open));
    return clients;
  }

  void begin_to_stop() {
    {
      const std::lock_guard lock(context_.mutex);
      if (context_.stopping) return;
      context_.stopping = true;
    }
    const auto clients = open_clients();
    error_code ignored;
    acceptor_.close(ignored);
    datagrams_.close(ignored);
    signals_.cancel(ignored);
    for (const auto& client : clients) client->close(1001, "the server stops");
    timer_.expires_after(clients.empty() ? std::chrono::milliseconds(0) : kFarewell);
    timer_.async_wait([this](error_code) { context_.io.stop(); });
  }

  NetworkContext context_;
  asio::strand<asio::io_context::executor_type> strand_{context_.io.get_executor()};
  tcp::acceptor acceptor_{strand_};
  udp::socket datagrams_{strand_};
  asio::signal_set signals_{strand_};
  asio::steady_timer timer_{strand_};
  std::array<char, kDatagramBytes> datagram_{};
  udp::endpoint sender_;
  int port_ = 0;
  int udp_port_ = 0;
};

Network::Network(const ServerOptions& options, NetworkHandlers handlers)
    : work_(std::make_shared<Work>(options, std::move(handlers))) {}
Network::~Network() = default;
int Network::port() const {
  return work_->port();
}
int Network::udp_port() const {
  return work_->udp_port();
}
void Network::run() {
  work_->run();
}
void Network::stop() {
  work_->stop();
}

}  // namespace eigengrasp::server
