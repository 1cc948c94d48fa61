// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/session_hub.hpp"

#include <fmt/core.h>

#include <random>

namespace eigengrasp::server {

namespace {

bool is_for_trackers(const wire::ClientMessage& message) {
  return std::holds_alternative<wire::Wrist>(message) || std::holds_alternative<wire::Targets>(message) ||
         std::holds_alternative<wire::Command>(message);
}

}  // namespace

std::optional<std::string> session_named_in(const wire::ClientMessage& message) {
  if (const auto* m = std::get_if<wire::Wrist>(&message)) return m->session;
  if (const auto* m = std::get_if<wire::Targets>(&message)) return m->session;
  if (const auto* m = std::get_if<wire::Command>(&message)) return m->session;
  return {};
}

std::shared_ptr<AppSession> SessionHub::open(std::shared_ptr<Client> client) {
  std::random_device random;  // plans are named after sessions: nobody shall guess them
  const std::lock_guard lock(mutex_);
  auto session = std::make_shared<AppSession>(services_, std::move(client),
                                              fmt::format("s{}-{:08x}", ++opened_, random()));
  std::erase_if(sessions_, [](const auto& s) { return s.expired(); });
  sessions_.push_back(session);
  return session;
}

std::shared_ptr<AppSession> SessionHub::find(const std::optional<std::string>& name) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<AppSession> found;
  std::uint64_t latest = 0;
  for (const auto& weak : sessions_) {
    auto session = weak.lock();
    if (!session) continue;
    if (name && session->name() == *name) return session;
    if (!name && session->online_since() > latest) {
      latest = session->online_since();
      found = std::move(session);
    }
  }
  return found;
}

std::string SessionHub::route(const wire::ClientMessage& message, const std::optional<std::string>& usual,
                              Clock::time_point arrived) {
  if (!is_for_trackers(message))
    return fmt::format("a tracker sent '{}', expected wrist, targets or command", wire::type_of(message));
  auto name = session_named_in(message);
  if (!name) name = usual;
  const auto session = find(name);
  if (!session)
    return name ? fmt::format("there is no session '{}'; the app shows the name of its session", *name)
                : "no app runs an online planner; start one on the app's page Interactive";
  session->take(message, arrived);
  return {};
}

void SessionHub::take_datagram(std::string_view text) {
  const auto now = Clock::now();
  std::string sentence;
  try {
    sentence = route(wire::parse_client_message(text), {}, now);
  } catch (const Error& e) {
    sentence = e.what();
  }
  if (sentence.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    if (now < complained_ + std::chrono::seconds(1)) return;
    complained_ = now;
  }
  fmt::print(stderr, "eigengrasp: a datagram was dropped: {}\n", sentence);
}

void SessionHub::end_all() {
  std::vector<std::shared_ptr<AppSession>> open;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& weak : sessions_)
      if (auto session = weak.lock()) open.push_back(std::move(session));
  }
  for (const auto& session : open) session->end();
}

}  // namespace eigengrasp::server
