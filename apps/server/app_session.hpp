// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "server/online_job.hpp"
#include "server/plan_job.hpp"

namespace eigengrasp::server {

/// What an app does on one connection: at most one plan and one online planner at a time. From any thread;
/// does not block.
class AppSession {
 public:
  AppSession(Services& services, std::shared_ptr<Client> client, std::string name)
      : services_(services), outlet_(std::make_shared<Outlet>(std::move(client))), name_(std::move(name)) {}
  ~AppSession() { end(); }

  const std::string& name() const { return name_; }
  Outlet& outlet() { return *outlet_; }
  /// Any message but hello.
  void take(const wire::ClientMessage& message, Clock::time_point arrived);
  /// Whether an online planner runs, and how recently it began: larger is later, 0: none.
  std::uint64_t online_since() const { return online_since_.load(); }
  /// Ends what runs, and sends nothing more of it.
  void end();

 private:
  void begin_log();
  void start(const wire::PlanStart& message);
  void start(const wire::OnlineStart& message);

  Services& services_;
  std::shared_ptr<Outlet> outlet_;
  std::string name_;
  std::mutex mutex_;
  std::shared_ptr<PlanJob> plan_;
  std::shared_ptr<OnlineJob> online_;
  std::atomic<std::uint64_t> online_since_{0};
  int plans_ = 0;
  bool log_begun_ = false;
  bool ended_ = false;
};

}  // namespace eigengrasp::server
