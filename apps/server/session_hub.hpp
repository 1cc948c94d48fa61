// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/app_session.hpp"

namespace eigengrasp::server {

/// The session that a message names.
std::optional<std::string> session_named_in(const wire::ClientMessage& message);

/// The sessions of all apps, and which of them a tracker moves. From any thread.
class SessionHub {
 public:
  explicit SessionHub(Services& services) : services_(services) {}

  std::shared_ptr<AppSession> open(std::shared_ptr<Client> client);
  /// Hands a tracker's message to the session that it names, else to `usual`, else to the one whose online
  /// planner began last. Returns the sentence that says why it could not be; empty: done.
  std::string route(const wire::ClientMessage& message, const std::optional<std::string>& usual,
                    Clock::time_point arrived);
  /// A datagram of a tracker. What is wrong with it is said on stderr, once a second at most.
  void take_datagram(std::string_view text);
  void end_all();

 private:
  std::shared_ptr<AppSession> find(const std::optional<std::string>& name);

  Services& services_;
  std::mutex mutex_;
  std::vector<std::weak_ptr<AppSession>> sessions_;
  int opened_ = 0;
  Clock::time_point complained_{};
};

}  // namespace eigengrasp::server
