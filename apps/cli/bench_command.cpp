// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <cmath>

#include "cli/commands.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/experiments/performance.hpp"
#include "eigengrasp/model_io/model_library.hpp"

namespace eigengrasp::cli {

namespace {

struct BenchChoice {
  std::vector<std::string> hands;
  std::vector<std::string> objects{"glass"};
  std::filesystem::path graspit;
  std::string search = "staged";
  std::filesystem::path json;
  std::filesystem::path markdown;
  PerformanceOptions options;
};

struct BenchScene {
  Scene scene;
  std::optional<PaperHand> paper_hand;
};

void require_sound(BenchChoice& choice) {
  PerformanceOptions& o = choice.options;
  if (!(o.seconds > 0.0) || !std::isfinite(o.seconds))
    fail("--seconds is {}, expected more than 0", o.seconds);
  if (o.threads < 0 || o.threads > 4096) fail("--threads is {}, expected 0 (all) to 4096", o.threads);
  if (o.iterations < 1) fail("--iterations is {}, expected 1 or more", o.iterations);
  if (choice.search != "paper" && choice.search != "staged")
    fail("--search is '{}', expected staged or paper", choice.search);
  o.search = choice.search == "paper" ? SearchKind::paper : SearchKind::staged;
  for (const auto& file : {choice.json, choice.markdown})
    if (!file.empty() && file != "-") require_writable_folder(std::filesystem::absolute(file).parent_path());
}

/// Of a shipped hand.
std::optional<PaperHand> paper_hand_of(const std::string& name) {
  for (const PaperHand hand : kPaperHands)
    if (name.starts_with(name_of(hand))) return hand;
  return {};
}

std::vector<BenchScene> graspit_scenes(const BenchChoice& choice) {
  const ModelSource source = find_graspit_models(choice.graspit);
  std::vector<PaperHand> hands;
  std::vector<PaperObject> objects;
  for (const std::string& name : choice.hands) hands.push_back(parse_paper_hand(name));
  if (hands.empty()) hands.assign(kPaperHands.begin(), kPaperHands.end());
  for (const std::string& name : choice.objects) objects.push_back(parse_paper_object(name));
  const PaperScenes all(source, hands, objects, warn);
  std::vector<BenchScene> scenes;
  for (const PaperHand hand : hands)
    for (const PaperObject object : objects)
      scenes.push_back({all.scene(hand, object, FrictionCase::materials), hand});
  return scenes;
}

std::vector<BenchScene> named_scenes(const BenchChoice& choice) {
  std::vector<std::string> hands = choice.hands;
  if (hands.empty())
    for (const NamedModel& hand : list_hands()) hands.push_back(hand.name);
  std::vector<BenchScene> scenes;
  for (Scene& scene : load_scenes(hands, choice.objects)) {
    const auto paper_hand = paper_hand_of(scene.hand->name);
    scenes.push_back({std::move(scene), paper_hand});
  }
  return scenes;
}

std::string command_text(const CLI::App& command, const BenchChoice& choice) {
  std::string text = "eigengrasp bench";
  if (!choice.graspit.empty()) text += " --graspit DIR";
  for (const std::string& hand : choice.hands) text += " --hand " + hand;
  if (command.count("--object") > 0)
    for (const std::string& object : choice.objects) text += " --object " + object;
  if (command.count("--search") > 0) text += " --search " + choice.search;
  if (command.count("--iterations") > 0) text += fmt::format(" --iterations {}", choice.options.iterations);
  if (command.count("--seconds") > 0) text += fmt::format(" --seconds {}", choice.options.seconds);
  if (command.count("--threads") > 0) text += fmt::format(" --threads {}", choice.options.threads);
  if (!choice.markdown.empty()) text += " --markdown FILE";
  return text;
}

/// Measures scene by scene and prints. @return false where Ctrl-C ended it
bool measure(const std::vector<BenchScene>& scenes, std::FILE* text, PerformanceReport& report) {
  const InterruptGuard guard;
  report.options.stop = &guard.stop_flag();
  report.wrench = measure_wrench_space(std::min(1.0, report.options.seconds));
  fmt::print(text, "8 contacts x 8 edges: closure {:.1f} us, epsilon {:.1f} us\n",
             1e6 * report.wrench.closure, 1e6 * report.wrench.epsilon);
  for (const BenchScene& bench : scenes) {
    ScenePerformance measured = measure_performance(bench.scene, report.options);
    if (guard.interrupted()) return false;
    measured.paper_hand = bench.paper_hand;
    fmt::print(text, "{}", performance_text(measured));
    std::fflush(text);
    report.scenes.push_back(std::move(measured));
  }
  return true;
}

int run_bench(const CLI::App& command, BenchChoice choice) {
  require_sound(choice);
  const std::vector<BenchScene> scenes =
      choice.graspit.empty() ? named_scenes(choice) : graspit_scenes(choice);
  PerformanceReport report;
  report.record = make_record(command_text(command, choice));
  report.options = choice.options;
  std::FILE* const text = choice.json == "-" ? stderr : stdout;
  fmt::print(text, "eigengrasp {}; {}\n", report.record.version, describe(report.record.machine));
  if (!measure(scenes, text, report)) {
    fmt::print(stderr, "eigengrasp: stopped; nothing was written\n");
    return nothing_found;
  }
  if (choice.json == "-") fmt::print("{}", performance_json(report));
  if (!choice.json.empty() && choice.json != "-")
    write_file_atomically(choice.json, performance_json(report));
  if (!choice.markdown.empty()) write_file_atomically(choice.markdown, performance_markdown(report));
  return success;
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<BenchChoice>();
  CLI::App* command = app.add_subcommand("bench", "Measure how fast the planner is on this machine");
  command
      ->add_option("--hand", choice->hands,
                   "Hands as of 'plan' (default: all shipped); with --graspit: barrett, dlr, robonaut, "
                   "human")
      ->delimiter(',');
  command
      ->add_option("--object", choice->objects,
                   "Objects as of 'plan' (default: glass); with --graspit: ashtray, shoe, glass, flask, "
                   "phone, plane")
      ->delimiter(',');
  command->add_option("--graspit", choice->graspit,
                      "Folder of GraspIt!'s models: its hands and objects instead of the shipped ones");
  command->add_option("--search", choice->search, "staged or paper, as of 'plan'");
  command->add_option("--iterations", choice->options.iterations, "States of each run (default: 70000)");
  command->add_option("--seconds", choice->options.seconds,
                      "Time for each rate of each hand, object and number of threads (default: 1)");
  command->add_option("--threads", choice->options.threads,
                      "What \"all threads\" means (0: all of the machine)");
  command->add_option("--json", choice->json, "Writes the figures to this file; -: to the standard output");
  command->add_option(
      "--markdown", choice->markdown,
      "Writes a page with the figures beside GraspIt!'s, such as docs/results/performance.md");
  command->footer(
      "Measures on one thread and on all: states of the search, candidates, their steps, preparation, "
      "memory.\n"
      "Examples:\n"
      "  eigengrasp bench --hand human --object glass --seconds 5\n"
      "  eigengrasp bench --graspit ~/graspit/models --markdown docs/results/performance.md");
  command->callback([command, choice, &exit_code] { exit_code = run_bench(*command, *choice); });
}

}  // namespace eigengrasp::cli
