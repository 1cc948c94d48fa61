// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/plan_options_cli.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/jobs/database_build.hpp"

namespace eigengrasp::cli {

namespace {

struct BuildChoice {
  std::string store;
  std::vector<std::string> hands = {"barrett-metal", "barrett-rubber", "human"};
  std::string time_limit = "60s";
  std::string lease;  ///< empty: by the time limit
  bool slurm = false;
  std::vector<std::string> sbatch_options;  ///< all words that are not ours
  BuildOptions options;
};

std::string time_text(double seconds) {
  const int minutes = static_cast<int>(seconds / 60.0);
  if (minutes >= 60) return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
  if (minutes > 0) return fmt::format("{} min {:02} s", minutes, static_cast<int>(seconds) % 60);
  return fmt::format("{:.0f} s", seconds);
}

double a_unit(std::int64_t n, const BuildProgress& p) {
  return p.ended_now > 0 ? static_cast<double>(n) / static_cast<double>(p.ended_now) : 0.0;
}

std::string progress_text(const BuildProgress& p) {
  const double rate = static_cast<double>(p.ended_now) / std::max(p.seconds, 1e-3);
  return fmt::format("{} of {} units, {:.2f}/s, {} left, {:.1f} grasps a unit, {} failed", p.ended, p.units,
                     rate, time_text(static_cast<double>(p.units - p.ended) / std::max(rate, 1e-9)),
                     a_unit(p.grasps_now, p), p.failed_now);
}

/// The options of the jobs of an array, which plan as this call would.
std::vector<std::string> words_of_jobs(const BuildChoice& choice) {
  const UnitOptions& unit = choice.options.unit;
  std::vector<std::string> words{"--hands",      fmt::format("{}", fmt::join(choice.hands, ",")),
                                 "--grasps",     std::to_string(unit.grasps),
                                 "--states",     std::to_string(unit.states),
                                 "--time-limit", choice.time_limit,
                                 "--seed",       std::to_string(unit.seed)};
  if (!choice.lease.empty()) words.insert(words.end(), {"--lease", choice.lease});
  return words;
}

int run_build(BuildChoice choice) {
  if (!choice.slurm && !choice.sbatch_options.empty())
    fail("found '{}', which is no option of 'db build' (see 'eigengrasp db build --help')",
         choice.sbatch_options.front());
  BuildOptions& options = choice.options;
  options.unit.time_limit = parse_seconds("--time-limit", choice.time_limit);
  if (!choice.lease.empty()) options.lease = parse_seconds("--lease", choice.lease);
  for (const std::string& name : choice.hands) options.hands.push_back(load_hand_choice({name, {}, {}}));
  if (const auto violations = options.validate(); !violations.empty()) fail("{}", violations.front());
  const auto store = open_to_write(choice.store, options.only_waiting);
  if (store->counts().models == 0)
    fail("{}: holds no objects; 'eigengrasp db add-objects' adds them", store->place());
  if (choice.slurm) {
    add_work(*store, options);
    submit_to_slurm(choice.store, {choice.sbatch_options, words_of_jobs(choice)});
    return success;
  }
  options.cache = user_cache();
  const InterruptGuard guard;
  options.stop = &guard.stop_flag();
  BuildReport report;
  {
    ProgressBar bar;
    options.progress = [&](const BuildProgress& p) {
      bar.show(static_cast<double>(p.ended) / static_cast<double>(std::max<std::int64_t>(p.units, 1)),
               progress_text(p));
    };
    report = build_database(*store, options);
  }
  const BuildProgress& p = report.end;
  fmt::print("{}: {} units in {}, {} of them failed, {} grasps ({:.1f} a unit); {} of {} units have ended\n",
             store->place(), p.ended_now, time_text(p.seconds), p.failed_now, p.grasps_now,
             a_unit(p.grasps_now, p), p.ended, p.units);
  if (report.stopped) fmt::print(stderr, "eigengrasp: stopped; the same command goes on\n");
  return report.stopped ? nothing_found : success;
}

}  // namespace

void add_db_build(CLI::App& db, int& exit_code) {
  auto choice = std::make_shared<BuildChoice>();
  BuildOptions& options = choice->options;
  CLI::App* build = db.add_subcommand("build", "Plan grasps of all objects of a store");
  build->add_option("store", choice->store, kStoreHelp)->required();
  build
      ->add_option("--hands", choice->hands,
                   "Names or files of hands (default: barrett-metal,barrett-rubber,human)")
      ->delimiter(',');
  build->add_option("--scales", options.scales, "Scales, ascending (default: 0.75,1,1.25,1.5)")
      ->delimiter(',');
  build->add_option("--grasps", options.unit.grasps,
                    "Form-closed grasps of each unit that are enough (default: 15)");
  build->add_option("--states", options.unit.states,
                    "States of the search after which it gives up (default: 100000)");
  build->add_option("--time-limit", choice->time_limit,
                    "Of a unit, such as 60s or 2min; a safety net, noted beside the unit (default: 60s)");
  build->add_option("--lease", choice->lease,
                    "How long units stay with a worker that is not heard of any more, such as 60s (default: "
                    "three time limits and two minutes)");
  build->add_option("--seed", options.unit.seed, "Of all units (default: 1)");
  build->add_option("--jobs", options.jobs,
                    "Threads, an object each (default: all); does not change the result");
  build->add_flag("--retry-failed", options.retry_failed, "Let failed units wait again first");
  build->add_flag("--only-waiting", options.only_waiting,
                  "Build what waits in the store and add nothing to it; for workers that join a build");
  build->add_flag("--slurm", choice->slurm,
                  "Submit a job array to Slurm instead; all words that are not options of this command go to "
                  "sbatch. The store must be PostgreSQL");
  build->allow_extras();
  build->footer(
      "A unit is an object at a scale with a hand; it is stored when it ends. The same command goes on where "
      "it was\n"
      "stopped or killed, and others may build the same store (SQLite, PostgreSQL) at the same time.\n"
      "Examples:\n"
      "  eigengrasp db build sqlite:grasps.db\n"
      "  eigengrasp db build postgresql://me@localhost/grasps --hands human,robonaut --grasps 25 --jobs 8\n"
      "  eigengrasp db build postgresql://me@server/grasps --slurm --partition=cpu\n"
      "Exit code: 0, 1 stopped by Ctrl-C (what has ended is stored), 2 bad input.");
  build->callback([build, choice, &exit_code] {
    choice->sbatch_options = build->remaining();
    exit_code = run_build(*choice);
  });
}

}  // namespace eigengrasp::cli
