// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/jobs/database_verify.hpp"

namespace eigengrasp::cli {

namespace {

struct VerifyChoice {
  std::string store;
  std::vector<std::string> hands;
  VerifyOptions options;
};

/// Those of --hands, else all of the store, which have to be known by name.
std::vector<std::string> hands_to_verify(const VerifyChoice& choice, GraspStore& store) {
  if (!choice.hands.empty()) return choice.hands;
  std::vector<std::string> names;
  for (const auto& [hand, n] : store.counts().grasps_by_hand)
    if (n > 0) names.push_back(hand);
  return names;
}

int run_verify(VerifyChoice choice) {
  const auto store = open_to_read(choice.store);
  VerifyOptions& options = choice.options;
  for (const std::string& hand : hands_to_verify(choice, *store))
    options.hands.push_back(load_hand_choice({hand, {}, {}}));
  options.cache = user_cache();
  const InterruptGuard guard;
  options.stop = &guard.stop_flag();
  VerifyReport report;
  {
    ProgressBar bar;
    options.progress = [&](double share) { bar.show(share, "verified"); };
    report = verify_grasps(*store, options);
  }
  for (const UnverifiedGrasp& bad : report.bad)
    fmt::print("grasp {} of {} at scale {} with {}: {}\n", bad.id, bad.key.object, bad.key.scale,
               bad.key.hand, bad.reason);
  fmt::print("{}: {} grasps simulated again, {} of them do not reproduce", store->place(), report.grasps,
             report.bad.size());
  if (report.foreign > 0) fmt::print("; {} of other programs left out", report.foreign);
  fmt::print("\n");
  if (report.stopped) fmt::print(stderr, "eigengrasp: stopped before the end\n");
  return report.bad.empty() && !report.stopped ? success : nothing_found;
}

}  // namespace

void add_db_verify(CLI::App& db, int& exit_code) {
  auto choice = std::make_shared<VerifyChoice>();
  CLI::App* verify =
      db.add_subcommand("verify", "Simulate stored grasps again and say which do not reproduce");
  verify->add_option("store", choice->store, kStoreToReadHelp)->required();
  verify->add_option("--hands", choice->hands, "Only grasps with these; names or files (default: all)")
      ->delimiter(',');
  verify->add_option("--objects", choice->options.objects, "Only of these objects (default: all)")
      ->delimiter(',');
  verify->add_option("--every", choice->options.every, "Only each so many-th grasp of an object and a hand")
      ->check(CLI::PositiveNumber);
  verify->add_option("--jobs", choice->options.threads, "Threads (default: all)");
  verify->footer(
      "Examples:\n"
      "  eigengrasp db verify sqlite:grasps.db\n"
      "  eigengrasp db verify sqlite:grasps.db --every 20\n"
      "Exit code: 0 all reproduce, 1 some do not, 2 bad input.");
  verify->callback([choice, &exit_code] { exit_code = run_verify(*choice); });
}

}  // namespace eigengrasp::cli
