// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "eigengrasp/online/online_planner.hpp"
#include "eigengrasp/wire/session_log.hpp"

namespace eigengrasp::wire {

/// What an operator did between one online.start and the next, or its stop.
struct RecordedTask {
  OnlineStart start;
  std::vector<LogLine> input;  ///< wrist, targets, command; t counts from the first of them
  std::vector<Closed> closed;  ///< what each close made then
};

/// The online tasks of a log, in their order.
std::vector<RecordedTask> recorded_tasks(std::span<const LogLine> log);

struct ReplayOptions {
  double speed = 1.0;  ///< of the recording's time; 0: one after the other, without waiting
  /// Hears what there is to be shown after each input; may be empty.
  std::function<void(const OnlineView&)> seen = {};
  /// Hears what each close made; may be empty.
  std::function<void(const std::optional<Grasp>&)> closed = {};
};

/// Plays the input of a task into a planner of the same scene and options.
/// @throws Error where the planner refuses targets.
void replay(const RecordedTask& task, OnlinePlanner& planner, const ReplayOptions& options = {});

}  // namespace eigengrasp::wire
