// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/http_connection.hpp"

#include <fmt/format.h>

#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <optional>

#include "eigengrasp/core/error.hpp"
#include "server/web_address.hpp"
#include "server/websocket_connection.hpp"

namespace eigengrasp::server {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

constexpr std::uint32_t kHeaderBytes = 16384;
constexpr int kUploadsAtATime = 2;
constexpr auto kPatience = std::chrono::seconds(30);
constexpr auto kFarewell = std::chrono::seconds(2);
constexpr auto kUploadPatience = std::chrono::seconds(120);
constexpr const char* kContentPolicy =
    "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self' ws: wss: blob: data:; worker-src 'self' blob:; frame-ancestors 'none'";

std::string text_of(beast::string_view view) {
  return {view.data(), view.size()};
}

std::optional<HttpRequest> understood(const http::request<http::string_body>& message) {
  const auto target = parse_target({message.target().data(), message.target().size()});
  if (!target) return {};
  HttpRequest request;
  request.method = message.method() == http::verb::head ? "GET" : text_of(message.method_string());
  request.path = target->path;
  request.query = target->query;
  request.host = text_of(message[http::field::host]);
  request.origin = text_of(message[http::field::origin]);
  request.authorization = text_of(message[http::field::authorization]);
  request.websocket = beast::websocket::is_upgrade(message);
  return request;
}

/// One request after the other.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(NetworkContext& context, asio::ip::tcp::socket socket, std::shared_ptr<void> ticket)
      : context_(context), ticket_(std::move(ticket)), stream_(std::move(socket)) {}

  void begin() {
    asio::dispatch(stream_.get_executor(), [self = shared_from_this()] { self->read_header(); });
  }

 private:
  void read_header() {
    upload_ticket_.reset();
    parser_.emplace();
    parser_->header_limit(kHeaderBytes);
    parser_->body_limit(static_cast<std::uint64_t>(context_.options.limits.upload_bytes));
    stream_.expires_after(kPatience);
    http::async_read_header(stream_, buffer_, *parser_,
                            beast::bind_front_handler(&HttpConnection::on_header, shared_from_this()));
  }

  void on_header(error_code error, std::size_t) {
    if (error == http::error::body_limit) return refuse_and_close(413, too_large());
    if (error == http::error::header_limit)
      return refuse_and_close(431, fmt::format("the header is larger than {} bytes", kHeaderBytes));
    if (error == http::error::end_of_stream || error == asio::error::eof || error == beast::error::timeout ||
        error == asio::error::connection_reset)
      return close();
    if (error) return refuse_and_close(400, "this is no request of HTTP/1.1 that is sound");
    const auto request = understood(parser_->get());
    if (!request) return refuse_and_close(400, "the path is not sound, expected /PATH with %XX escapes");
    request_ = *request;
    if (auto reply = context_.handlers.admit(request_)) return write(*reply, true);
    if (request_.websocket) return upgrade();
    if (parser_->is_done()) return answer();
    if (!context_.handlers.takes_body(request_))
      return refuse_and_close(413, "found a body, expected none at this path");
    upload_ticket_ = Counter::take(context_.uploads, kUploadsAtATime);
    if (!upload_ticket_) return refuse_and_close(503, "other uploads are under way; try again in a moment");
    stream_.expires_after(kUploadPatience);
    http::async_read(stream_, buffer_, *parser_,
                     beast::bind_front_handler(&HttpConnection::on_body, shared_from_this()));
  }

  void on_body(error_code error, std::size_t) {
    if (error == http::error::body_limit) return refuse_and_close(413, too_large());
    if (error) return close();
    answer();
  }

  std::string too_large() const {
    return fmt::format("the body is larger than {} bytes, the most that is taken",
                       context_.options.limits.upload_bytes);
  }

  void upgrade() {
    auto ticket = Counter::take(context_.clients, context_.options.limits.clients);
    if (!ticket)
      return refuse_and_close(
          503, fmt::format("{} clients are connected, the most that are let in; close one of them",
                           context_.options.limits.clients));
    begin_websocket(context_, std::move(stream_), parser_->release(), {ticket_, std::move(ticket)});
  }

  void answer() {
    request_.body = std::move(parser_->get().body());
    stream_.expires_never();
    asio::post(context_.workers, [self = shared_from_this()] {
      HttpReply reply;
      try {
        reply = self->context_.handlers.answer(self->request_);
      } catch (const Error& e) {
        reply = refusal(400, e.what());
      } catch (const std::exception& e) {
        reply = refusal(500, e.what());
      }
      asio::post(self->stream_.get_executor(),
                 [self, reply = std::move(reply)] { self->write(reply, false); });
    });
  }

  void refuse_and_close(int status, const std::string& sentence) { write(refusal(status, sentence), true); }

  void write(const HttpReply& reply, bool then_close) {
    upload_ticket_.reset();
    const auto& request = parser_->get();
    reply_ = {};
    reply_.version(11);
    reply_.result(static_cast<unsigned>(reply.status));
    reply_.set(http::field::content_type, reply.content_type);
    reply_.set(http::field::cache_control, "no-cache");
    reply_.set("Content-Security-Policy", kContentPolicy);
    reply_.set("X-Content-Type-Options", "nosniff");
    reply_.set("Referrer-Policy", "no-referrer");
    if (reply.status == 401) reply_.set(http::field::www_authenticate, "Bearer");
    if (!reply.file_name.empty())
      reply_.set(http::field::content_disposition,
                 fmt::format("attachment; filename=\"{}\"", reply.file_name));
    reply_.keep_alive(!then_close && request.keep_alive());
    reply_.body() = reply.body;
    reply_.prepare_payload();
    stream_.expires_after(kPatience);
    serializer_.emplace(reply_);
    auto done = beast::bind_front_handler(&HttpConnection::on_written, shared_from_this());
    if (request.method() == http::verb::head)
      http::async_write_header(stream_, *serializer_, std::move(done));
    else
      http::async_write(stream_, *serializer_, std::move(done));
  }

  void on_written(error_code error, std::size_t) {
    if (error || !reply_.keep_alive()) return close();
    read_header();
  }

  void close() {
    error_code error;
    stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, error);
    if (error) return;
    stream_.expires_after(kFarewell);
    discard_next();
  }

  /// What a client still sends is read away for a while, or its end of the connection would break before it
  /// has read the answer.
  void discard_next() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(16384),
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (!error) self->discard_next();
                            });
  }

  NetworkContext& context_;
  std::shared_ptr<void> ticket_;
  std::shared_ptr<void> upload_ticket_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{65536};
  std::optional<http::request_parser<http::string_body>> parser_;
  HttpRequest request_;
  http::response<http::string_body> reply_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
};

}  // namespace

void begin_http(NetworkContext& context, asio::ip::tcp::socket socket, std::shared_ptr<void> ticket) {
  std::make_shared<HttpConnection>(context, std::move(socket), std::move(ticket))->begin();
}

}  // namespace eigengrasp::server
