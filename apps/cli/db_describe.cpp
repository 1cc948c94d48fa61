// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/jobs/store_describe.hpp"

namespace eigengrasp::cli {

namespace {

struct DescribeChoice {
  std::string store;
  DescribeOptions options;
};

int run_describe(DescribeChoice choice) {
  DescribeOptions& options = choice.options;
  if (const auto violations = options.validate(); !violations.empty()) fail("{}", violations.front());
  const auto store = open_to_update(choice.store);
  if (store->counts().models == 0)
    fail("{}: holds no objects; 'eigengrasp db add-objects' adds them", store->place());
  const InterruptGuard guard;
  options.stop = &guard.stop_flag();
  DescribeReport report;
  {
    ProgressBar bar;
    options.progress = [&](double share, const std::string& what) { bar.show(share, what); };
    report = describe_store(*store, options);
  }
  for (const std::string& sentence : report.bad) warn(sentence + "; left out");
  fmt::print(
      "{}: {} objects described, {} were; views of {} objects, {} neighbours and {} alignments are new\n",
      store->place(), report.described, report.there, report.viewed, report.neighbors, report.alignments);
  if (report.stopped) fmt::print(stderr, "eigengrasp: stopped; the same command goes on\n");
  return report.stopped ? nothing_found : success;
}

}  // namespace

void add_db_describe(CLI::App& db, int& exit_code) {
  auto choice = std::make_shared<DescribeChoice>();
  DescribeOptions& options = choice->options;
  CLI::App* describe = db.add_subcommand(
      "describe", "Shape descriptors, nearest neighbours and alignments of all objects of a store");
  describe->add_option("store", choice->store, kStoreHelp)->required();
  describe->add_option("--neighbors", options.neighbors, "Of each object (default: 5)");
  describe->add_flag("!--no-views", options.views, "No descriptors of views, by which scans find their like");
  describe->add_flag("!--no-align", options.align, "No alignments, which take half of the time");
  describe->add_option("--jobs", options.threads, "Threads (default: all); does not change the result");
  describe->footer(
      "What is there is kept: the same command goes on where it was stopped, and describes what was added "
      "since.\n"
      "Objects whose geometry is missing or has changed are named on stderr and left out.\n"
      "Examples:\n"
      "  eigengrasp db describe sqlite:grasps.db\n"
      "  eigengrasp db describe sqlite:grasps.db --neighbors 25 --no-align\n"
      "Exit code: 0, 1 stopped by Ctrl-C (what is done is stored), 2 bad input.");
  describe->callback([choice, &exit_code] { exit_code = run_describe(*choice); });
}

}  // namespace eigengrasp::cli
