// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/latency_probe.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <exception>
#include <future>
#include <thread>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/wire/message_makers.hpp"
#include "eigengrasp/wire/wire_text.hpp"
#include "server/server.hpp"

namespace eigengrasp::server {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using boost::system::error_code;

/// A server in a thread of its own, ended with the object.
class LocalServer {
 public:
  explicit LocalServer(std::shared_ptr<PreparationCache> files) {
    std::promise<Running> ready;
    std::future<Running> running = ready.get_future();
    thread_ = std::jthread([this, files = std::move(files), ready = std::move(ready)]() mutable {
      ServerOptions options;
      options.port = 0;
      bool began = false;
      try {
        serve(options, std::move(files), [&](const ServerAddress& address, const auto& stop) {
          began = true;
          ready.set_value({address.port, stop});
        });
      } catch (...) {
        if (!began) ready.set_exception(std::current_exception());
      }
    });
    running_ = running.get();
  }
  ~LocalServer() { running_.stop(); }
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  int port() const { return running_.port; }

 private:
  struct Running {
    int port = 0;
    std::function<void()> stop;
  };
  Running running_;
  std::jthread thread_;
};

/// A client that moves the wrist as an operator does, and notes when each pose is shown.
class Probe {
 public:
  Probe(const Scene& scene, const ProbeOptions& options, int port)
      : options_(options), operator_(scene, options.traits, options.seed) {
    const tcp::endpoint server(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
    beast::get_lowest_layer(socket_).connect(server);
    beast::get_lowest_layer(socket_).set_option(tcp::no_delay(true));
    socket_.read_message_max(wire::kServerText.bytes);
    socket_.handshake(fmt::format("127.0.0.1:{}", port), "/ws");
    say(wire::Hello{});
    wire::OnlineStart start;
    start.hand = scene.hand->name;
    start.object = scene.object->name;
    say(start);
    while (true) {
      const wire::ServerMessage message = hear();
      if (std::holds_alternative<wire::OnlineReady>(message)) break;
      if (const auto* error = std::get_if<wire::ErrorMessage>(&message)) fail("{}", error->message);
    }
  }

  std::vector<double> run() {
    operator_.begin();
    watch_.lap();
    read_next();
    send_next();
    io_.run();
    error_code ignored;
    beast::get_lowest_layer(socket_).close(ignored);
    if (failure_) fail("the server ended early: {}", failure_.message());
    return latencies_;
  }

 private:
  void say(const wire::ClientMessage& message) { socket_.write(asio::buffer(wire::to_text(message))); }

  wire::ServerMessage hear() {
    socket_.read(buffer_);
    return take();
  }

  wire::ServerMessage take() {
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    return wire::parse_server_message(text);
  }

  void read_next() {
    socket_.async_read(buffer_, [this](error_code error, std::size_t) {
      if (error) return end(error);
      const double now = watch_.seconds();
      const wire::ServerMessage message = take();
      if (const auto* view = std::get_if<wire::View>(&message); view && view->wrist)
        note(view->wrist->time, now);
      if (now > options_.seconds) return end({});
      read_next();
    });
  }

  void note(double pose_time, double now) {
    if (pose_time <= shown_) return;
    shown_ = pose_time;
    latencies_.push_back(now - pose_time);
  }

  /// The wrist moves towards the object as if nothing were offered. Its poses carry the time at which they
  /// are sent.
  void send_next() {
    const double period = 1.0 / options_.poses_per_second;
    timer_.expires_after(
        std::chrono::duration_cast<asio::steady_timer::duration>(std::chrono::duration<double>(period)));
    timer_.async_wait([this, period](error_code error) {
      if (error) return;
      (void)operator_.step(OnlineView{}, period);
      wire::Wrist wrist;
      wrist.pose = wire::pose_numbers(operator_.wrist());
      wrist.time = watch_.seconds();
      outgoing_ = wire::to_text(wire::ClientMessage{wrist});
      socket_.async_write(asio::buffer(outgoing_), [this](error_code failed, std::size_t) {
        if (failed) return end(failed);
        send_next();
      });
    });
  }

  void end(error_code error) {
    failure_ = error;
    io_.stop();
  }

  const ProbeOptions& options_;
  SimulatedOperator operator_;
  asio::io_context io_;
  beast::websocket::stream<tcp::socket> socket_{io_};
  asio::steady_timer timer_{io_};
  beast::flat_buffer buffer_;
  std::string outgoing_;
  StopWatch watch_;
  double shown_ = -1.0;  ///< time of the newest pose that was shown
  std::vector<double> latencies_;
  error_code failure_;
};

}  // namespace

std::vector<double> measure_wire_latency(const Scene& scene, std::shared_ptr<PreparationCache> files,
                                         const ProbeOptions& options) {
  const LocalServer server(std::move(files));
  return Probe(scene, options, server.port()).run();
}

}  // namespace eigengrasp::server
