// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "eigengrasp/core/parallel.hpp"
#include "server/outlet.hpp"
#include "server/services.hpp"

namespace eigengrasp::server {

/// One plan.start, in a thread of its own: tells of progress and milestones, then of the result.
class PlanJob {
 public:
  PlanJob(Services& services, std::shared_ptr<Outlet> outlet, wire::PlanStart start, std::string id)
      : services_(services), outlet_(std::move(outlet)), start_(std::move(start)), id_(std::move(id)) {}

  /// The thread's work.
  void run();
  /// Ends the search; what was found is sent.
  void stop() { stop_.request_stop(); }
  /// Ends the search; nothing more is sent.
  void abandon() {
    abandoned_.store(true);
    stop_.request_stop();
  }
  bool ended() const { return ended_.load(); }

 private:
  void plan();
  void send(const wire::ServerMessage& message, Kind kind = Kind::lasting) {
    if (!abandoned_.load()) outlet_->send(message, kind);
  }

  Services& services_;
  std::shared_ptr<Outlet> outlet_;
  wire::PlanStart start_;
  std::string id_;
  StopFlag stop_;
  std::atomic<bool> abandoned_{false};
  std::atomic<bool> ended_{false};
};

}  // namespace eigengrasp::server
