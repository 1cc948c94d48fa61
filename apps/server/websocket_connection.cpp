// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/websocket_connection.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <cstdint>

#include "server/outgoing_queue.hpp"

namespace eigengrasp::server {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

constexpr std::uint64_t kViewsOnTheWay = 8;  ///< at 60 a second: full rate up to 130 ms away

/// Everything but send and close runs on the strand of the stream.
class WebSocketConnection final : public OpenClient,
                                  public std::enable_shared_from_this<WebSocketConnection> {
 public:
  WebSocketConnection(NetworkContext& context, beast::tcp_stream stream,
                      std::vector<std::shared_ptr<void>> tickets)
      : context_(context),
        tickets_(std::move(tickets)),
        ws_(std::move(stream)),
        watch_(ws_.get_executor()),
        queue_(context.options.limits.queued_bytes) {}

  void begin(const UpgradeRequest& request) {
    beast::get_lowest_layer(ws_).expires_never();
    const auto silent = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(context_.options.limits.silent_seconds));
    ws_.set_option(websocket::stream_base::timeout{std::chrono::seconds(10), silent, true});
    ws_.read_message_max(static_cast<std::size_t>(context_.options.limits.message_bytes));
    ws_.auto_fragment(false);
    ws_.control_callback([this](websocket::frame_type frame, beast::string_view payload) {
      on_control(frame, payload);  // while a read is on the way, which holds this
    });
    ws_.async_accept(request, beast::bind_front_handler(&WebSocketConnection::on_accept, shared_from_this()));
  }

  void send(std::string text, Kind kind) override {
    asio::post(ws_.get_executor(), [self = shared_from_this(), text = std::move(text), kind]() mutable {
      self->push(std::move(text), kind);
    });
  }

  void close(int code, std::string reason) override {
    asio::post(ws_.get_executor(), [self = shared_from_this(), code, reason = std::move(reason)] {
      if (self->close_reason_) return;
      self->close_reason_ = websocket::close_reason(static_cast<websocket::close_code>(code), reason);
      self->close_begun_ = Clock::now();
      self->write_next();
    });
  }

  void end_now() override { end(); }

 private:
  void on_accept(error_code error) {
    if (error) return;
    {
      const std::lock_guard lock(context_.mutex);
      if (context_.stopping) return;
      std::erase_if(context_.open_clients, [](const auto& c) { return c.expired(); });
      context_.open_clients.push_back(weak_from_this());
    }
    began_ = Clock::now();
    handler_ = context_.handlers.connected(shared_from_this());
    read_next();
    watch_next();
  }

  void read_next() {
    ws_.async_read(buffer_, beast::bind_front_handler(&WebSocketConnection::on_read, shared_from_this()));
  }

  void on_read(error_code error, std::size_t) {
    if (error) return end();
    const auto arrived = Clock::now();
    if (ws_.got_text())
      handler_->on_text({static_cast<const char*>(buffer_.data().data()), buffer_.size()}, arrived);
    else
      handler_->on_binary();
    buffer_.consume(buffer_.size());
    if (!ended_) read_next();
  }

  void push(std::string text, Kind kind) {
    if (ended_ || close_reason_) return;
    if (!queue_.push(std::move(text), kind)) return drop();
    write_next();
  }

  void write_next() {
    if (ended_ || writing_) return;
    auto next = queue_.pop(views_written_ - views_received_ < kViewsOnTheWay);
    if (!next) {
      if (close_reason_) close_now();
      return;
    }
    writing_ = true;
    write_begun_ = Clock::now();
    on_the_way_ = std::move(*next);
    ws_.text(true);
    ws_.async_write(asio::buffer(on_the_way_.text),
                    beast::bind_front_handler(&WebSocketConnection::on_write, shared_from_this()));
  }

  void on_write(error_code error, std::size_t) {
    if (error) return end();
    if (on_the_way_.kind == Kind::view) return ask_for_receipt();
    writing_ = false;
    write_next();
  }

  /// A ping follows each view; its pong says that the view arrived. So few views are on the way that a slow
  /// client sees the newest, instead of what waits in the buffers of the network.
  void ask_for_receipt() {
    websocket::ping_data number;
    if (views_written_ == views_received_) receipt_since_ = Clock::now();
    number.assign(std::to_string(++views_written_));
    ws_.async_ping(number, [self = shared_from_this()](error_code error) {
      self->writing_ = false;
      if (error) return self->end();
      self->write_next();
    });
  }

  void on_control(websocket::frame_type frame, beast::string_view payload) {
    if (frame != websocket::frame_type::pong) return;
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(payload.data(), payload.data() + payload.size(), number);
    if (error != std::errc() || number <= views_received_ || number > views_written_) return;
    views_received_ = number;
    receipt_since_ = Clock::now();
    write_next();
  }

  void close_now() {
    writing_ = true;  // nothing is sent any more
    write_begun_ = Clock::now();
    ws_.async_close(*close_reason_, [self = shared_from_this()](error_code) { self->end(); });
  }

  /// Once a second: who reads nothing, does not say hello, or does not answer a close, is dropped.
  void watch_next() {
    watch_.expires_after(std::chrono::seconds(1));
    watch_.async_wait([self = shared_from_this()](error_code error) {
      if (error || self->ended_) return;
      const ServerLimits& limits = self->context_.options.limits;
      const auto longer = [now = Clock::now()](Clock::time_point since, double seconds) {
        return std::chrono::duration<double>(now - since).count() > seconds;
      };
      const bool behind = self->views_written_ - self->views_received_ >= kViewsOnTheWay;
      if ((self->writing_ && longer(self->write_begun_, limits.slow_seconds)) ||
          (behind && longer(self->receipt_since_, limits.slow_seconds)) ||
          (self->close_reason_ && longer(self->close_begun_, limits.slow_seconds)) ||
          (!self->handler_->is_known() && longer(self->began_, limits.hello_seconds)))
        return self->drop();
      self->watch_next();
    });
  }

  /// Without a farewell: the other side does not listen.
  void drop() {
    error_code ignored;
    beast::get_lowest_layer(ws_).socket().close(ignored);
    end();
  }

  void end() {
    if (ended_) return;
    ended_ = true;
    watch_.cancel();
    if (handler_) handler_->on_closed();
  }

  NetworkContext& context_;
  std::vector<std::shared_ptr<void>> tickets_;
  websocket::stream<beast::tcp_stream> ws_;
  asio::steady_timer watch_;
  beast::flat_buffer buffer_;
  std::shared_ptr<ClientHandler> handler_;
  OutgoingQueue queue_;
  OutgoingQueue::Message on_the_way_;
  std::uint64_t views_written_ = 0;
  std::uint64_t views_received_ = 0;
  std::optional<websocket::close_reason> close_reason_;
  Clock::time_point began_, write_begun_, receipt_since_, close_begun_;
  bool writing_ = false;
  bool ended_ = false;
};

}  // namespace

void begin_websocket(NetworkContext& context, beast::tcp_stream stream, const UpgradeRequest& request,
                     std::vector<std::shared_ptr<void>> tickets) {
  std::make_shared<WebSocketConnection>(context, std::move(stream), std::move(tickets))->begin(request);
}

}  // namespace eigengrasp::server
