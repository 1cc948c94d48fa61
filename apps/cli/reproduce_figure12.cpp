// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/experiments/figure12.hpp"

namespace eigengrasp::cli {

namespace {

struct Figure12Choice {
  std::string store;
  std::filesystem::path out = "docs/results";
  std::vector<std::string> hands = {"barrett-rubber", "human"};
  Figure12Options options;
};

std::string command_text(const Figure12Choice& choice) {
  const Figure12Options& o = choice.options;
  std::string text =
      fmt::format("eigengrasp reproduce figure12 --store STORE --hands {} --neighbors {} --seed {}",
                  fmt::join(choice.hands, ","), o.neighbors, o.seed);
  if (o.candidates > 0) text += fmt::format(" --candidates {}", o.candidates);
  if (o.every > 1) text += fmt::format(" --every {}", o.every);
  if (o.models > 0) text += fmt::format(" --models {}", o.models);
  return text;
}

Figure12 run_with_progress(GraspStore& store, Figure12Options options) {
  ProgressBar bar;
  const InterruptGuard guard;
  options.stop = &guard.stop_flag();
  options.progress = [&](double share, const std::string& what) { bar.show(share, what); };
  return run_figure12(store, options);
}

/// Everything is made before the first file is written.
void write_result(const Figure12& result, const Figure12Choice& choice) {
  const ExperimentRecord record = make_record(command_text(choice));
  const std::string markdown = figure12_markdown(result, record);
  const std::string json = figure12_json(result, record);
  for (std::size_t h = 0; h < result.hands.size(); ++h) {
    save_png(figure12_picture(result, h), choice.out / "figure12" / (result.hands[h] + ".png"));
    write_file_atomically(choice.out / "figure12" / (result.hands[h] + ".svg"), figure12_svg(result, h));
  }
  write_file_atomically(choice.out / "figure12.json", json);
  write_file_atomically(choice.out / "figure12.md", markdown);
}

int reproduce_figure12(Figure12Choice choice) {
  Figure12Options& options = choice.options;
  const auto store = open_to_read(choice.store);
  for (const std::string& hand : choice.hands) options.hands.push_back(load_hand_choice({hand, {}, {}}));
  if (const auto violations = options.validate(); !violations.empty()) fail("{}", violations.front());
  require_writable_folder(choice.out);
  options.progress_file = choice.out / "figure12-progress.jsonl";
  const Figure12 result = run_with_progress(*store, options);
  if (result.stopped_early) {
    fmt::print(stderr, "eigengrasp: stopped; the same command goes on\n");
    return nothing_found;
  }
  write_result(result, choice);
  std::filesystem::remove(options.progress_file);
  for (std::size_t h = 0; h < result.hands.size(); ++h)
    for (std::size_t m = 0; m < kFigure12Methods.size(); ++m) {
      const Figure12Curve& c = result.curves[h][m];
      fmt::print("{:<16} {:<8} epsilon of grasp 1, 10, 25: {:.4f} {:.4f} {:.4f}; {:.1f} distinct, {:.2f} s\n",
                 result.hands[h], kFigure12Methods[m], c.epsilon[0], c.epsilon[9], c.epsilon[24], c.distinct,
                 c.seconds);
    }
  fmt::print("{} models, {} left out; written to {}\n", result.models, result.left_out.size(),
             (choice.out / "figure12.md").string());
  return success;
}

}  // namespace

void add_reproduce_figure12(CLI::App& reproduce, int& exit_code) {
  const auto choice = std::make_shared<Figure12Choice>();
  Figure12Options& o = choice->options;
  CLI::App* command = reproduce.add_subcommand(
      "figure12", "Fig. 12: grasps by like objects, leaving one out, beside the planner's own");
  command->add_option("--store", choice->store, kStoreHelp)->required();
  command->add_option("--out", choice->out, "Folder for the results")->capture_default_str();
  command->add_option("--hands", choice->hands, "Hands of the store (default: barrett-rubber,human)")
      ->delimiter(',');
  command->add_option("--neighbors", o.neighbors, "Of each model (default: 5)");
  command->add_option(
      "--candidates", o.candidates,
      "Pre-grasps of a neighbour at a scale, those of the highest epsilon; 0: all (default: 0)");
  command->add_option("--every", o.every, "Only each so many-th model of the store (default: 1)");
  command->add_option("--models", o.models, "At most so many models; 0: all (default: 0)");
  command->add_option("--seed", o.seed, "Of random neighbours and of the choice within a class (default: 1)");
  command->add_option("--threads", o.threads, "0: all, a model each; does not change the curves");
  command->footer(
      "Needs a store that is built and described ('eigengrasp db build', 'eigengrasp db describe').\n"
      "Writes figure12.md, figure12.json and the folder figure12 with plots.\n"
      "Examples:\n"
      "  eigengrasp reproduce figure12 --store sqlite:grasps.db --every 50 --out trial\n"
      "  eigengrasp reproduce figure12 --store sqlite:grasps.db\n"
      "Exit code: 0, 1 stopped by Ctrl-C (the same command goes on), 2 bad input.");
  command->callback([choice, &exit_code] { exit_code = reproduce_figure12(*choice); });
}

}  // namespace eigengrasp::cli
