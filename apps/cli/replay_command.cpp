// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <cmath>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/wire/message_makers.hpp"
#include "eigengrasp/wire/session_replay.hpp"

namespace eigengrasp::cli {

namespace {

struct ReplayChoice {
  std::filesystem::path log;
  std::string hand;    ///< empty: that of the log
  std::string object;  ///< likewise
  double speed = 1.0;
};

/// How a grasp ended, in a few characters.
std::string outcome(bool any, bool form_closure, double epsilon) {
  if (!any) return "touches nothing";
  return form_closure ? fmt::format("epsilon {:.3f}", epsilon) : "not form-closed";
}

std::string outcome(const std::optional<Grasp>& grasp) {
  return grasp ? outcome(true, grasp->form_closure, grasp->epsilon) : outcome(false, false, 0.0);
}

std::string outcome(const wire::RecordedTask& task, std::size_t close) {
  if (close >= task.closed.size()) return "not recorded";
  const std::optional<wire::GraspShape>& grasp = task.closed[close].grasp;
  return grasp ? outcome(true, grasp->form_closure, grasp->epsilon) : outcome(false, false, 0.0);
}

Scene scene_of(const wire::OnlineStart& start, const ReplayChoice& choice) {
  SceneChoice scene;
  scene.hand.name = choice.hand.empty() ? start.hand : choice.hand;
  scene.object = choice.object.empty() ? start.object : choice.object;
  scene.scale = start.scale;
  if (start.table) scene.table = "auto";
  scene.friction = start.options.friction;
  return load_scene(scene);
}

/// @returns the closes that made a form-closed grasp now
int replay_task(const wire::RecordedTask& task, std::size_t number, const ReplayChoice& choice) {
  const Scene scene = scene_of(task.start, choice);
  OnlinePlanner planner(scene, wire::online_options(task.start), user_cache());
  const double seconds = task.input.empty() ? 0.0 : task.input.back().t;
  fmt::print("task {}: {} on {}, {} inputs in {:.1f} s\n", number, scene.hand->name, scene.object->name,
             task.input.size(), seconds);
  std::size_t close = 0;
  int form_closed = 0;
  OnlineRates rates;
  wire::ReplayOptions options;
  options.speed = choice.speed;
  options.seen = [&](const OnlineView& view) { rates = view.rates; };
  options.closed = [&](const std::optional<Grasp>& grasp) {
    fmt::print("  close {}: {}; then {}\n", close + 1, outcome(grasp), outcome(task, close));
    std::fflush(stdout);
    form_closed += grasp && grasp->form_closure;
    ++close;
  };
  wire::replay(task, planner, options);
  fmt::print("  {} postures, {} candidates tested, {} form-closed\n", rates.postures, rates.candidates,
             rates.form_closed);
  return form_closed;
}

int run_replay(const ReplayChoice& choice) {
  if (!(choice.speed >= 0.0) || !std::isfinite(choice.speed))
    fail("--speed is {}, expected 0 (without waiting) or more", choice.speed);
  const std::vector<wire::RecordedTask> tasks = wire::recorded_tasks(wire::read_session_log(choice.log));
  if (tasks.empty()) fail("'{}' holds no interactive session, expected an online.start", choice.log.string());
  int form_closed = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) form_closed += replay_task(tasks[i], i + 1, choice);
  return form_closed > 0 ? success : nothing_found;
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<ReplayChoice>();
  CLI::App* command = app.add_subcommand("replay", "Play a session log into the online planner again");
  command->add_option("log", choice->log, "A log that `eigengrasp serve --log DIR` wrote")->required();
  command->add_option("--hand", choice->hand,
                      "Instead of the log's hand, such as one that was uploaded then");
  command->add_option("--object", choice->object, "Instead of the log's object, likewise");
  command->add_option("--speed", choice->speed, "Of the recording's time (default: 1; 0: without waiting)");
  command->footer(
      "Says of each click what closing the hand makes now, and what it made when the log was written.\n"
      "Examples:\n"
      "  eigengrasp replay logs/20261127T101500-3f9a.jsonl\n"
      "  eigengrasp replay session.jsonl --hand dlr --object mug.stl\n"
      "Exit code: 0 a click made a form-closed grasp, 1 none did, 2 bad input.");
  command->callback([choice, &exit_code] { exit_code = run_replay(*choice); });
}

}  // namespace eigengrasp::cli
