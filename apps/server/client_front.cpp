// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/client_front.hpp"

#include "eigengrasp/core/version.hpp"
#include "server/web_address.hpp"

namespace eigengrasp::server {

namespace {
constexpr int kPolicyViolation = 1008;
}

ClientFront::ClientFront(Services& services, SessionHub& hub, std::shared_ptr<Client> client)
    : services_(services),
      hub_(hub),
      client_(std::move(client)),
      rate_(services.options.limits.messages_per_second, Clock::now()) {}

void ClientFront::on_text(std::string_view text, Clock::time_point arrived) {
  if (!rate_.pass(arrived)) {
    if (!std::exchange(told_of_rate_, true))
      refuse(wire::ErrorCode::too_fast,
             fmt::format("messages come faster than {} a second; the rest is dropped",
                         services_.options.limits.messages_per_second));
    return;
  }
  try {
    const wire::TextLimits limits{static_cast<std::size_t>(services_.options.limits.message_bytes)};
    const wire::ClientMessage message = wire::parse_client_message(text, limits);
    unsound_ = 0;
    if (role_)
      pass_on(message, arrived);
    else
      greet(message);
  } catch (const Error& e) {
    if (role_) return refuse_unsound(e.what());
    turn_away(wire::ErrorCode::bad_message, e.what(), {});
  }
}

void ClientFront::on_binary() {
  if (!client_) return;
  refuse_unsound("found a binary message, expected text: one object of JSON");
}

void ClientFront::greet(const wire::ClientMessage& message) {
  const auto* hello = std::get_if<wire::Hello>(&message);
  if (hello == nullptr)
    return turn_away(wire::ErrorCode::not_allowed,
                     fmt::format("found '{}' as the first message, expected hello", wire::type_of(message)),
                     wire::type_of(message));
  const std::string& token = services_.options.token;
  if (!token.empty() && !equal_in_constant_time(hello->token.value_or(""), token))
    return turn_away(wire::ErrorCode::not_allowed,
                     hello->token
                         ? "the token is not the server's; it is what --token said when it was started"
                         : "there is no token, expected what --token said when the server was started",
                     wire::Hello::type);
  if (hello->protocol != wire::kProtocol)
    return turn_away(wire::ErrorCode::not_allowed,
                     fmt::format("found version {} of the protocol, expected {}; reload the page, or update "
                                 "the program",
                                 hello->protocol, wire::kProtocol),
                     wire::Hello::type);
  role_ = hello->role;
  wire::Welcome welcome;
  welcome.version = version();
  welcome.role = hello->role;
  welcome.limits = services_.wire_limits();
  if (hello->role == wire::Role::app) {
    session_ = hub_.open(client_);
    welcome.session = session_->name();
  } else {
    tracked_session_ = hello->session;
  }
  client_->send(wire::to_text(wire::ServerMessage(welcome)), Kind::lasting);
}

void ClientFront::pass_on(const wire::ClientMessage& message, Clock::time_point arrived) {
  if (std::holds_alternative<wire::Hello>(message))
    return refuse(wire::ErrorCode::not_allowed, "hello was said already; connect again to say another",
                  "hello");
  if (session_) {
    if (const auto named = session_named_in(message); named && *named != session_->name())
      return refuse(
          wire::ErrorCode::not_allowed,
          fmt::format("an app named the session '{}', expected its own, {}, or none; only trackers move "
                      "others",
                      *named, session_->name()),
          wire::type_of(message));
    return session_->take(message, arrived);
  }
  const std::string sentence = hub_.route(message, tracked_session_, arrived);
  if (!sentence.empty()) refuse(wire::ErrorCode::no_session, sentence, wire::type_of(message));
}

void ClientFront::refuse(wire::ErrorCode code, const std::string& sentence, std::string_view of) {
  if (client_) Outlet(client_).refuse(code, sentence, of);
}

void ClientFront::refuse_unsound(const std::string& sentence) {
  refuse(wire::ErrorCode::bad_message, sentence);
  if (++unsound_ >= most_unsound && client_)
    client_->close(kPolicyViolation, "too many messages that are not sound");
}

void ClientFront::turn_away(wire::ErrorCode code, const std::string& sentence, std::string_view of) {
  refuse(code, sentence, of);
  if (client_) client_->close(kPolicyViolation, "hello was not accepted");
}

void ClientFront::on_closed() {
  if (session_) session_->end();
  session_.reset();
  client_.reset();  // which holds this
}

}  // namespace eigengrasp::server
