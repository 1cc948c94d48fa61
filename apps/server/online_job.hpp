// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "eigengrasp/online/online_planner.hpp"
#include "server/outlet.hpp"
#include "server/services.hpp"

namespace eigengrasp::server {

/// One online.start, in a thread of its own: prepares the scene, hands the operator's input to the planner in
/// the order in which it came, and shows what there is at once after a new wrist pose and otherwise 60 times
/// a second.
class OnlineJob {
 public:
  OnlineJob(Services& services, std::shared_ptr<Outlet> outlet, wire::OnlineStart start, std::string session)
      : services_(services),
        outlet_(std::move(outlet)),
        start_(std::move(start)),
        session_(std::move(session)) {}

  /// The thread's work.
  void run();
  /// Takes wrist, targets, command or solution.get; returns at once. Where too much waits, the oldest wrist
  /// pose is dropped.
  void give(wire::ClientMessage message, Clock::time_point arrived);
  /// @param tell whether online.stopped is sent
  void stop(bool tell);

 private:
  struct Input {
    wire::ClientMessage message;
    Clock::time_point arrived;
  };
  static constexpr std::size_t most_waiting = 256;

  void plan_online();
  void make_planner(const OnlineOptions& options);
  /// Waits until there is input or the time has come; none where the session ended.
  std::optional<std::deque<Input>> wait_until(Clock::time_point time);
  void take(const wire::ClientMessage& message);
  void close_hand(OperatorCommand command);
  void answer(const wire::SolutionGet& message);
  void show(std::optional<Clock::time_point> wrist_arrived);

  Services& services_;
  std::shared_ptr<Outlet> outlet_;
  wire::OnlineStart start_;
  std::string session_;
  std::shared_ptr<const CollisionModel> model_;  // outlives the planner
  std::unique_ptr<OnlinePlanner> planner_;
  std::optional<wire::View::Offer> offer_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Input> waiting_;
  bool stopped_ = false;
  bool tell_ = true;
};

}  // namespace eigengrasp::server
