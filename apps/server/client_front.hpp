// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "server/rate_limit.hpp"
#include "server/session_hub.hpp"

namespace eigengrasp::server {

/// What stands between a WebSocket and the sessions: hello and token, rate, sound messages, and whether the
/// client is an app or a tracker.
class ClientFront final : public ClientHandler {
 public:
  ClientFront(Services& services, SessionHub& hub, std::shared_ptr<Client> client);

  void on_text(std::string_view text, Clock::time_point arrived) override;
  void on_binary() override;
  void on_closed() override;
  bool is_known() const override { return role_.has_value(); }

 private:
  void greet(const wire::ClientMessage& message);
  void pass_on(const wire::ClientMessage& message, Clock::time_point arrived);
  void refuse(wire::ErrorCode code, const std::string& sentence, std::string_view of = {});
  /// One message that is not sound; too many in a row end the connection.
  void refuse_unsound(const std::string& sentence);
  void turn_away(wire::ErrorCode code, const std::string& sentence, std::string_view of);

  static constexpr int most_unsound = 20;  ///< in a row

  Services& services_;
  SessionHub& hub_;
  std::shared_ptr<Client> client_;
  RateLimit rate_;
  bool told_of_rate_ = false;
  int unsound_ = 0;
  std::optional<wire::Role> role_;
  std::shared_ptr<AppSession> session_;         ///< of an app
  std::optional<std::string> tracked_session_;  ///< of a tracker
};

}  // namespace eigengrasp::server
