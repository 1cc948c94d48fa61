// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/experiments/table2_report.hpp"

namespace eigengrasp::cli {

namespace {

/// What all experiments of the paper are asked with.
struct ReproduceChoice {
  std::filesystem::path graspit;
  std::filesystem::path out = "docs/results";
  std::vector<std::string> hands;
  std::vector<std::string> objects;
  int seeds = 5;
  std::int64_t iterations = 70000;
  int threads = 0;
  bool quick = false;
  bool pictures = true;
};

void add_reproduce_options(CLI::App& command, ReproduceChoice& choice) {
  command.add_option("--graspit", choice.graspit,
                     "Folder of GraspIt!'s models: its hands and objects instead of the shipped ones");
  command.add_option("--out", choice.out, "Folder for the results")->capture_default_str();
  command.add_option("--hand", choice.hands, "Only these hands of the paper: barrett, dlr, robonaut, human")
      ->delimiter(',');
  command
      .add_option("--object", choice.objects,
                  "Only these objects of the paper: ashtray, shoe, glass, flask, phone, plane")
      ->delimiter(',');
  command.add_option("--seeds", choice.seeds, "Runs of each cell, with the seeds 1, 2, ... (default: 5)");
  command.add_option("--iterations", choice.iterations, "States of each run (default: 70000)");
  command.add_option("--threads", choice.threads, "0: all; does not change the counts");
  command.add_flag("--quick", choice.quick,
                   "A trial: human hand on glass and flask, 1 seed, 3000 states, where nothing else is said");
  command.add_flag("!--no-pictures", choice.pictures, "No pictures");
}

/// What --quick means for options that were not given.
void apply_quick(const CLI::App& command, ReproduceChoice& choice) {
  if (command.count("--hand") == 0) choice.hands = {"human"};
  if (command.count("--object") == 0) choice.objects = {"glass", "flask"};
  if (command.count("--seeds") == 0) choice.seeds = 1;
  if (command.count("--iterations") == 0) choice.iterations = 3000;
}

/// Names in the order of the paper, each once.
template <typename Enum, std::size_t N>
std::vector<Enum> chosen(const std::vector<std::string>& names, const std::array<Enum, N>& all,
                         Enum (*parse)(const std::string&)) {
  if (names.empty()) return {all.begin(), all.end()};
  std::vector<bool> wanted(N);
  for (const std::string& name : names) wanted[static_cast<std::size_t>(parse(name))] = true;
  std::vector<Enum> picked;
  for (const Enum value : all)
    if (wanted[static_cast<std::size_t>(value)]) picked.push_back(value);
  return picked;
}

/// The command that makes the result again.
std::string command_text(const std::string& experiment, const CLI::App& command, const ReproduceChoice& c) {
  std::string text = "eigengrasp reproduce " + experiment;
  if (!c.graspit.empty()) text += " --graspit DIR";
  for (const std::string& hand : c.hands) text += " --hand " + hand;
  for (const std::string& object : c.objects) text += " --object " + object;
  if (c.quick || command.count("--seeds") > 0) text += fmt::format(" --seeds {}", c.seeds);
  if (c.quick || command.count("--iterations") > 0) text += fmt::format(" --iterations {}", c.iterations);
  if (c.threads > 0) text += fmt::format(" --threads {}", c.threads);
  return text;
}

Table2Options table2_options(const ReproduceChoice& choice) {
  Table2Options options;
  if (!choice.graspit.empty()) options.models = find_graspit_models(choice.graspit);
  options.hands = chosen(choice.hands, kPaperHands, parse_paper_hand);
  options.objects = chosen(choice.objects, kPaperObjects, parse_paper_object);
  options.seeds = choice.seeds;
  options.iterations = choice.iterations;
  options.threads = choice.threads;
  options.cache = user_cache();
  options.log = warn;
  if (const auto violations = options.validate(); !violations.empty()) fail("{}", violations.front());
  return options;
}

Table2 run_with_progress(Table2Options options) {
  ProgressBar bar;
  const InterruptGuard guard;
  options.stop = &guard.stop_flag();
  options.progress = [&](double share, const std::string& next) { bar.show(share, next); };
  return run_table2(options);
}

/// Everything is made before the first file is written.
void write_table2(const Table2& table, const ReproduceChoice& choice, const std::string& command) {
  const ExperimentRecord record = make_record(command);
  std::vector<ResultPicture> pictures;
  if (choice.pictures) pictures = table2_pictures(table, choice.threads);
  const std::string markdown = table2_markdown(table, record, pictures);
  const std::string json = table2_json(table, record);
  for (const ResultPicture& picture : pictures) save_png(picture.image, choice.out / picture.file);
  write_file_atomically(choice.out / "table2.json", json);
  write_file_atomically(choice.out / "table2.md", markdown);
}

void print_table2(const Table2& table, const ReproduceChoice& choice) {
  for (const Table2Part& part : table.parts)
    fmt::print("{:<7}{:<10} mean of {} cells {:.1f} form-closed of {}\n",
               part.search == SearchKind::paper ? "paper" : "staged",
               part.friction == FrictionCase::one ? "mu = 1" : "materials", part.cells.size(),
               part.mean_form_closed(), table.options.grasps);
  for (const Table2Target& target : check_targets(table))
    fmt::print("{}: {} ({})\n", target.met ? "met" : "not met", target.text, target.measured);
  fmt::print("written to {}\n", (choice.out / "table2.md").string());
}

int reproduce_table2(const CLI::App& command, ReproduceChoice choice) {
  if (choice.quick) apply_quick(command, choice);
  const Table2Options options = table2_options(choice);
  require_writable_folder(choice.out);
  const Table2 table = run_with_progress(options);
  if (table.stopped_early) {
    fmt::print(stderr, "eigengrasp: stopped; nothing was written\n");
    return nothing_found;
  }
  write_table2(table, choice, command_text("table2", command, choice));
  print_table2(table, choice);
  return success;
}

}  // namespace

void add_reproduce_command(CLI::App& app, int& exit_code) {
  CLI::App* reproduce = app.add_subcommand("reproduce", "Make the tables and figures of the paper again");
  reproduce->require_subcommand(1);
  auto choice = std::make_shared<ReproduceChoice>();
  CLI::App* table2 = reproduce->add_subcommand("table2", "Table II and Figs. 2 to 4: form-closed grasps");
  add_reproduce_options(*table2, *choice);
  table2->footer(
      "Writes table2.md, table2.json and the folder table2 with pictures.\n"
      "Examples:\n"
      "  eigengrasp reproduce table2 --quick --out trial\n"
      "  eigengrasp reproduce table2 --graspit ~/graspit/models\n"
      "Exit code: 0, 1 stopped by Ctrl-C (nothing is written), 2 bad input.");
  add_reproduce_table3(*reproduce);
  table2->callback([table2, choice, &exit_code] { exit_code = reproduce_table2(*table2, *choice); });
  add_reproduce_figure12(*reproduce, exit_code);
  add_reproduce_partial(*reproduce, exit_code);
  add_reproduce_retrieval(*reproduce, exit_code);
}

}  // namespace eigengrasp::cli
