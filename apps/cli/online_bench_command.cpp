// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <cmath>

#include "cli/commands.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/experiments/online_trial.hpp"
#include "eigengrasp/experiments/paper_scenes.hpp"
#include "server/latency_probe.hpp"

namespace eigengrasp::cli {

namespace {

struct OnlineBenchChoice {
  std::vector<std::string> hands{"barrett-rubber", "dlr", "robonaut", "human"};
  std::vector<std::string> objects{"ashtray", "shoe", "glass", "flask", "phone", "plane"};
  std::filesystem::path json;
  std::filesystem::path out;
  bool pictures = true;
  OnlineTrialOptions options;
};

void require_sound(const OnlineBenchChoice& choice) {
  const OnlineTrialOptions& o = choice.options;
  if (o.directions < 1 || o.directions > 100000)
    fail("--directions is {}, expected 1 to 100000", o.directions);
  if (o.approaches < 0 || o.approaches > 100000)
    fail("--approaches is {}, expected 0 to 100000", o.approaches);
  if (!choice.json.empty() && choice.json != "-")
    require_writable_folder(std::filesystem::absolute(choice.json).parent_path());
  if (!choice.out.empty()) require_writable_folder(choice.out);
}

std::string command_text(const CLI::App& command, const OnlineBenchChoice& choice) {
  std::string text = "eigengrasp online-bench";
  if (command.count("--hand") > 0)
    for (const std::string& hand : choice.hands) text += " --hand " + hand;
  if (command.count("--object") > 0)
    for (const std::string& object : choice.objects) text += " --object " + object;
  if (command.count("--directions") > 0) text += fmt::format(" --directions {}", choice.options.directions);
  if (command.count("--approaches") > 0) text += fmt::format(" --approaches {}", choice.options.approaches);
  if (command.count("--seed") > 0) text += fmt::format(" --seed {}", choice.options.seed);
  if (!choice.out.empty()) text += " --out DIR";
  return text;
}

/// @return false where Ctrl-C ended it
bool run_trials(const std::vector<Scene>& scenes, std::FILE* text, OnlineReport& report) {
  const InterruptGuard guard;
  report.options.stop = &guard.stop_flag();
  CollisionModel::Options collision;
  collision.cache = user_cache();
  for (const Scene& scene : scenes) {
    report.scenes.push_back(
        try_online(std::make_shared<const CollisionModel>(scene, collision), report.options));
    if (guard.interrupted()) return false;
    fmt::print(text, "{}", online_text(report.scenes.back()));
    std::fflush(text);
  }
  return true;
}

/// Of the human hand and the glass, where those were run; else of the first scene that has one.
std::size_t scene_to_draw(const OnlineReport& report) {
  std::size_t first = report.scenes.size();
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    const OnlineSceneTrial& s = report.scenes[i];
    if (s.moments.empty()) continue;
    if (s.hand == "human" && s.object == "glass") return i;
    first = std::min(first, i);
  }
  return first;
}

void write_page(const OnlineReport& report, const std::vector<Scene>& scenes,
                const OnlineBenchChoice& choice) {
  std::string page = online_markdown(report);
  const std::size_t drawn = scene_to_draw(report);
  if (choice.pictures && drawn < scenes.size()) {
    const ResultPicture picture = online_picture(scenes[drawn], report.scenes[drawn], 0);
    save_png(picture.image, choice.out / picture.file);
    page += fmt::format("\n![{}]({})\n\n{}.\n", picture.caption, picture.file, picture.caption);
  }
  write_file_atomically(choice.out / "online.json", online_json(report));
  write_file_atomically(choice.out / "online.md", page);
}

int run_online_bench(const CLI::App& command, const OnlineBenchChoice& choice) {
  require_sound(choice);
  const std::vector<Scene> scenes = load_scenes(choice.hands, choice.objects);
  OnlineReport report;
  report.record = make_record(command_text(command, choice));
  report.options = choice.options;
  std::FILE* const text = choice.json == "-" ? stderr : stdout;
  fmt::print(text, "eigengrasp {}; {}\n", report.record.version, describe(report.record.machine));
  if (!run_trials(scenes, text, report)) {
    fmt::print(stderr, "eigengrasp: stopped; nothing was written\n");
    return nothing_found;
  }
  report.wire_latency = server::measure_wire_latency(scenes.front(), user_cache(), {});
  fmt::print(text, "\n{}", online_targets(report));
  if (choice.json == "-") fmt::print("{}", online_json(report));
  if (!choice.json.empty() && choice.json != "-") write_file_atomically(choice.json, online_json(report));
  if (!choice.out.empty()) write_page(report, scenes, choice);
  return success;
}

}  // namespace

void add_online_bench_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<OnlineBenchChoice>();
  CLI::App* command =
      app.add_subcommand("online-bench", "Measure the online planner with a simulated operator");
  command->add_option("--hand", choice->hands, "Hands as of 'plan' (default: the paper's four)")
      ->delimiter(',');
  command->add_option("--object", choice->objects, "Objects as of 'plan' (default: the paper's six)")
      ->delimiter(',');
  command->add_option("--directions", choice->options.directions,
                      "New directions a scene, for the time to the first grasp (default: 40)");
  command->add_option("--approaches", choice->options.approaches,
                      "Approaches of the simulated operator a scene (default: 10)");
  command->add_option("--seed", choice->options.seed, "Of the operator and the planner (default: 1)");
  command->add_option("--json", choice->json, "Writes the figures to this file; -: to the standard output");
  command->add_option("--out", choice->out,
                      "Writes online.md, online.json and a picture of one approach to this folder, such as "
                      "docs/results");
  command->add_flag("!--no-picture", choice->pictures, "No picture");
  command->footer(
      "Runs in real time: about half a minute for each hand and object.\n"
      "Examples:\n"
      "  eigengrasp online-bench --hand human --object glass\n"
      "  eigengrasp online-bench --out docs/results");
  command->callback([command, choice, &exit_code] { exit_code = run_online_bench(*command, *choice); });
}

}  // namespace eigengrasp::cli
