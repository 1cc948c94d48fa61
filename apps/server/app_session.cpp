// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/app_session.hpp"

#include <ctime>

namespace eigengrasp::server {

namespace {

/// Such as 20260131-235959, of the machine's clock.
std::string time_stamp() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::localtime_r(&now, &parts);
  char text[32];
  const std::size_t length = std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &parts);
  return {text, length};
}

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> number{0};
  return ++number;
}

}  // namespace

void AppSession::begin_log() {
  if (log_begun_ || services_.options.logs.empty()) return;
  log_begun_ = true;
  try {
    outlet_->keep(std::make_shared<wire::SessionLogWriter>(services_.options.logs /
                                                           fmt::format("{}-{}.jsonl", time_stamp(), name_)));
  } catch (const Error& e) {
    outlet_->refuse(wire::ErrorCode::failed, e.what(), "");
  }
}

void AppSession::take(const wire::ClientMessage& message, Clock::time_point arrived) {
  const std::lock_guard lock(mutex_);
  if (ended_) return;
  begin_log();
  if (const auto log = outlet_->log()) log->write_in(message);
  if (const auto* plan = std::get_if<wire::PlanStart>(&message)) return start(*plan);
  if (const auto* online = std::get_if<wire::OnlineStart>(&message)) return start(*online);
  if (std::holds_alternative<wire::PlanStop>(message)) {
    if (plan_) plan_->stop();
    return;
  }
  if (!online_) {
    outlet_->refuse(wire::ErrorCode::no_session,
                    fmt::format("no online planner runs in session {}; send online.start first", name_),
                    wire::type_of(message));
  } else if (std::holds_alternative<wire::OnlineStop>(message)) {
    online_->stop(true);
    online_.reset();
    online_since_.store(0);
  } else {
    online_->give(message, arrived);
  }
}

void AppSession::start(const wire::PlanStart& message) {
  if (plan_) plan_->abandon();
  plan_.reset();
  auto ticket = Counter::take(services_.running_plans, services_.options.limits.plans);
  if (!ticket) {
    outlet_->refuse(wire::ErrorCode::busy,
                    fmt::format("{} plans run, the most at a time; wait until one ends, and start again",
                                services_.options.limits.plans),
                    wire::PlanStart::type);
    return;
  }
  plan_ = std::make_shared<PlanJob>(services_, outlet_, message, fmt::format("{}-plan-{}", name_, ++plans_));
  services_.background.run([job = plan_, ticket = std::move(ticket)] { job->run(); });
}

void AppSession::start(const wire::OnlineStart& message) {
  if (online_) online_->stop(false);
  online_.reset();
  online_since_.store(0);
  auto ticket = Counter::take(services_.online_sessions, services_.options.limits.online_sessions);
  if (!ticket) {
    outlet_->refuse(
        wire::ErrorCode::busy,
        fmt::format("{} online sessions run, the most at a time; wait until one ends, and start again",
                    services_.options.limits.online_sessions),
        wire::OnlineStart::type);
    return;
  }
  online_ = std::make_shared<OnlineJob>(services_, outlet_, message, name_);
  online_since_.store(next_number());
  services_.background.run([job = online_, ticket = std::move(ticket)] { job->run(); });
}

void AppSession::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  if (plan_) plan_->abandon();
  if (online_) online_->stop(false);
  plan_.reset();
  online_.reset();
  online_since_.store(0);
}

}  // namespace eigengrasp::server
