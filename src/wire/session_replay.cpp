// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/wire/session_replay.hpp"

#include <chrono>
#include <thread>

#include "eigengrasp/wire/message_makers.hpp"

namespace eigengrasp::wire {

namespace {

bool is_input(const ClientMessage& message) {
  return std::holds_alternative<Wrist>(message) || std::holds_alternative<Targets>(message) ||
         std::holds_alternative<Command>(message);
}

void play(const ClientMessage& message, OnlinePlanner& planner, const ReplayOptions& options) {
  if (const auto* wrist = std::get_if<Wrist>(&message)) planner.set_wrist(wrist_sample(*wrist));
  if (const auto* targets = std::get_if<Targets>(&message)) planner.set_targets(variable_targets(*targets));
  if (const auto* command = std::get_if<Command>(&message)) {
    const std::optional<Grasp> grasp = planner.command(command->command);
    if (command->command == OperatorCommand::close && options.closed) options.closed(grasp);
  }
}

}  // namespace

std::vector<RecordedTask> recorded_tasks(std::span<const LogLine> log) {
  std::vector<RecordedTask> tasks;
  bool running = false;
  double begin = 0.0;
  for (const LogLine& line : log) {
    const auto* message = std::get_if<ClientMessage>(&line.message);
    if (message == nullptr) {
      const auto* closed = std::get_if<Closed>(&std::get<ServerMessage>(line.message));
      if (running && closed != nullptr) tasks.back().closed.push_back(*closed);
      continue;
    }
    if (const auto* start = std::get_if<OnlineStart>(message)) {
      tasks.push_back({*start, {}, {}});
      running = true;
    } else if (std::holds_alternative<OnlineStop>(*message)) {
      running = false;
    } else if (running && is_input(*message)) {
      if (tasks.back().input.empty()) begin = line.t;
      tasks.back().input.push_back({line.t - begin, *message});
    }
  }
  return tasks;
}

void replay(const RecordedTask& task, OnlinePlanner& planner, const ReplayOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  for (const LogLine& line : task.input) {
    if (options.speed > 0.0)
      std::this_thread::sleep_until(start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                std::chrono::duration<double>(line.t / options.speed)));
    play(std::get<ClientMessage>(line.message), planner, options);
    if (options.seen) options.seen(planner.update());
  }
}

}  // namespace eigengrasp::wire
