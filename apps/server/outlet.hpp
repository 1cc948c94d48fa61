// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>
#include <string>

#include "eigengrasp/wire/session_log.hpp"
#include "eigengrasp/wire/wire_text.hpp"
#include "server/client.hpp"

namespace eigengrasp::server {

/// Where a session's messages go: to its client and into its log. From any thread.
class Outlet {
 public:
  explicit Outlet(std::shared_ptr<Client> client) : client_(std::move(client)) {}

  void send(const wire::ServerMessage& message, Kind kind = Kind::lasting) {
    std::string text = wire::to_text(message);
    if (const auto log = this->log()) log->write_out(text);
    client_->send(std::move(text), kind);
  }
  void refuse(wire::ErrorCode code, std::string sentence, std::string_view of) {
    if (sentence.size() > kSentence) sentence.resize(kSentence);
    wire::ErrorMessage message{code, std::move(sentence), {}};
    if (!of.empty()) message.of = std::string(of.substr(0, 64));
    send(message);
  }
  void keep(std::shared_ptr<wire::SessionLogWriter> log) {
    const std::lock_guard lock(mutex_);
    log_ = std::move(log);
  }
  std::shared_ptr<wire::SessionLogWriter> log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }
  Client& client() { return *client_; }

 private:
  static constexpr std::size_t kSentence = 2000;
  std::shared_ptr<Client> client_;
  std::mutex mutex_;
  std::shared_ptr<wire::SessionLogWriter> log_;
};

}  // namespace eigengrasp::server
