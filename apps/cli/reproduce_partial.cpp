// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/experiments/partial_scans.hpp"

namespace eigengrasp::cli {

namespace {

struct PartialChoice {
  std::string store;
  std::vector<std::string> same;
  std::vector<std::string> hands = {"barrett-rubber", "human"};
  std::filesystem::path out = "docs/results";
  PartialScansOptions options;
};

void read_same(const std::vector<std::string>& pairs, PartialScansOptions& options) {
  for (const std::string& pair : pairs) {
    const std::size_t equal = pair.find('=');
    if (equal == 0 || equal == std::string::npos || equal + 1 == pair.size())
      fail("--same is \"{}\", expected SCAN=COMPLETE, such as cheezit=cracker_box", pair);
    options.same[pair.substr(0, equal)] = pair.substr(equal + 1);
  }
}

int reproduce_partial(PartialChoice& choice) {
  const auto store = open_to_read(choice.store);
  require_writable_folder(choice.out);
  PartialScansOptions& options = choice.options;
  options.store = store.get();
  read_same(choice.same, options);
  for (const std::string& name : choice.hands) options.hands.push_back(load_hand_choice({name, {}, {}}));
  const InterruptGuard guard;
  options.stop = &guard.stop_flag();
  PartialScans result;
  {
    ProgressBar bar;
    options.progress = [&](int done, int all) {
      bar.show(done / static_cast<double>(all), fmt::format("{} of {}", done, all));
    };
    result = run_partial_scans(options);
  }
  if (result.stopped_early) {
    fmt::print(stderr, "eigengrasp: stopped; nothing was written\n");
    return nothing_found;
  }
  const ExperimentRecord record = make_record(
      fmt::format("eigengrasp reproduce partial --store STORE --complete DIR --scans DIR{}{} --neighbors {}",
                  choice.same.empty() ? "" : " --same ", fmt::join(choice.same, ","), options.neighbors));
  for (const ResultPicture& picture : result.pictures) save_png(picture.image, choice.out / picture.file);
  write_file_atomically(choice.out / "partial.json", partial_scans_json(result, record));
  write_file_atomically(choice.out / "partial.md", partial_scans_markdown(result, options, record));
  fmt::print("written to {}\n", (choice.out / "partial.md").string());
  return success;
}

}  // namespace

void add_reproduce_partial(CLI::App& reproduce, int& exit_code) {
  auto choice = std::make_shared<PartialChoice>();
  CLI::App* partial = reproduce.add_subcommand("partial", "Section VI-C: grasps from one view of an object");
  partial->add_option("--store", choice->store, kStoreHelp)->required();
  partial->add_option("--complete", choice->options.complete,
                      "Folder of complete objects, seen by simulated cameras");
  partial->add_option("--scans", choice->options.scans, "Folder of real scans, OBJECT/VIEW.ply, in metres");
  partial
      ->add_option("--same", choice->same,
                   "SCAN=COMPLETE for each scanned object whose complete one has another name")
      ->delimiter(',');
  partial->add_option("--hands", choice->hands, "Hands (default: barrett-rubber,human)")->delimiter(',');
  partial
      ->add_option("--neighbors", choice->options.neighbors,
                   "Objects of the store to take grasps of (default: 5)")
      ->check(CLI::Range(1, 1000));
  partial->add_option("--views", choice->options.views, "Simulated views of each object (default: 3)")
      ->check(CLI::Range(1, 100));
  partial->add_option("--seed", choice->options.seed, "Of noise and planner");
  partial->add_option("--threads", choice->options.threads, "0: all; does not change the result");
  partial->add_option("--out", choice->out, "Folder for the results")->capture_default_str();
  partial->add_flag("!--no-pictures", choice->options.pictures, "No pictures");
  partial->footer(
      "Writes partial.md, partial.json and the folder partial with pictures.\nExample:\n"
      "  eigengrasp reproduce partial --store sqlite:grasps.db --complete ycb --scans scans/realsense --same "
      "cheezit=cracker_box");
  partial->callback([choice, &exit_code] { exit_code = reproduce_partial(*choice); });
}

}  // namespace eigengrasp::cli
