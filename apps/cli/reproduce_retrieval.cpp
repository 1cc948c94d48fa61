// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <cstdlib>
#include <memory>

#include "cli/commands.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/progress_bar.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/experiments/psb_retrieval.hpp"

namespace eigengrasp::cli {

namespace {

struct RetrievalChoice {
  std::filesystem::path psb;
  std::filesystem::path out = "docs/results";
  std::size_t index_size = 0;
  int threads = 0;
  bool solid = true;
};

/// --psb, or where the test data is kept.
std::filesystem::path psb_folder(const RetrievalChoice& choice) {
  if (!choice.psb.empty()) return choice.psb;
  if (const char* data = std::getenv("EIGENGRASP_DATA")) return std::filesystem::path(data) / "psb_v1";
  fail("where the Princeton Shape Benchmark is has to be said with --psb, or by EIGENGRASP_DATA");
}

std::string command_text(const RetrievalChoice& choice) {
  std::string text = "eigengrasp reproduce psb-retrieval --psb DIR";
  if (choice.index_size > 0) text += fmt::format(" --index {}", choice.index_size);
  if (!choice.solid) text += " --no-solid";
  if (choice.threads > 0) text += fmt::format(" --threads {}", choice.threads);
  return text;
}

void print_result(const PsbRetrieval& result, const RetrievalChoice& choice) {
  for (const RetrievalRow& row : result.rows) {
    const RetrievalMeasures& m = row.measures;
    fmt::print("{:<6}{:<32} {:5.1f} {:5.1f} {:5.1f} {:5.1f} {:5.1f}\n", row.test ? "test" : "train", row.name,
               100 * m.nearest_neighbor, 100 * m.first_tier, 100 * m.second_tier, 100 * m.e_measure,
               100 * m.dcg);
  }
  fmt::print("written to {}\n", (choice.out / "psb-retrieval.md").string());
}

int reproduce_retrieval(const RetrievalChoice& choice) {
  PsbRetrievalOptions options;
  options.psb = psb_folder(choice);
  options.solid = choice.solid;
  options.index_size = choice.index_size;
  options.threads = choice.threads;
  require_writable_folder(choice.out);
  PsbRetrieval result;
  {
    ProgressBar bar;
    const InterruptGuard guard;
    options.stop = &guard.stop_flag();
    options.progress = [&](double share, const std::string& next) { bar.show(share, next); };
    result = run_psb_retrieval(options);
  }
  if (result.stopped_early) {
    fmt::print(stderr, "eigengrasp: stopped; nothing was written\n");
    return nothing_found;
  }
  const ExperimentRecord record = make_record(command_text(choice));
  const std::string markdown = psb_retrieval_markdown(result, record);
  const std::string json = psb_retrieval_json(result, record);
  save_png(psb_retrieval_picture(result), choice.out / "psb-retrieval/precision-recall.png");
  write_file_atomically(choice.out / "psb-retrieval/precision-recall.svg", psb_retrieval_svg(result));
  write_file_atomically(choice.out / "psb-retrieval.json", json);
  write_file_atomically(choice.out / "psb-retrieval.md", markdown);
  print_result(result, choice);
  return success;
}

}  // namespace

void add_reproduce_retrieval(CLI::App& reproduce, int& exit_code) {
  const auto choice = std::make_shared<RetrievalChoice>();
  CLI::App* command = reproduce.add_subcommand(
      "psb-retrieval", "How well the shape descriptor finds shapes of the same class");
  command->add_option("--psb", choice->psb,
                      "Folder of the Princeton Shape Benchmark (default: $EIGENGRASP_DATA/psb_v1)");
  command->add_option("--out", choice->out, "Folder for the results")->capture_default_str();
  command->add_option("--index", choice->index_size,
                      "Also measures the index, over this many descriptors (1000000: 5 minutes)");
  command->add_option("--threads", choice->threads, "0: all; does not change the measures");
  command->add_flag("!--no-solid", choice->solid,
                    "Leaves out the descriptors of the solid, most of the time");
  command->footer(
      "Writes psb-retrieval.md, psb-retrieval.json and the folder psb-retrieval with a plot.\n"
      "Examples:\n"
      "  eigengrasp reproduce psb-retrieval --psb ~/psb_v1 --no-solid --out trial\n"
      "  eigengrasp reproduce psb-retrieval --psb ~/psb_v1 --index 1000000\n"
      "Exit code: 0, 1 stopped by Ctrl-C (nothing is written), 2 bad input.");
  command->callback([choice, &exit_code] { exit_code = reproduce_retrieval(*choice); });
}

}  // namespace eigengrasp::cli
