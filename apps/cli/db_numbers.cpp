// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// eigengrasp db status, stats
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "cli/db_parts.hpp"
#include "cli/plan_options_cli.hpp"
#include "eigengrasp/jobs/database_statistics.hpp"

namespace eigengrasp::cli {

namespace {

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string describe(const UnitKey& key) {
  return fmt::format("{} at scale {} with {}", key.object, key.scale, key.hand);
}

double mean(double sum, std::int64_t n) {
  return n > 0 ? sum / static_cast<double>(n) : 0.0;
}

/// What the store does not know: how fast units end. Without a measurement the bound is told as a bound.
void print_rate(const BuildStatus& s, double seconds, std::int64_t ended_meanwhile) {
  fmt::print("cost        {:.2f} core-seconds a unit\n", s.mean_seconds);
  const auto left = static_cast<double>(s.counts.waiting + s.counts.claimed);
  if (seconds > 0.0) {
    const double rate = static_cast<double>(ended_meanwhile) / seconds;
    fmt::print("rate        {:.2f} units/s, measured over {:.0f} s", rate, seconds);
    if (rate > 0.0 && left > 0.0) fmt::print(", {:.1f} min left", left / rate / 60.0);
  } else if (s.rate == 0.0) {
    fmt::print("rate        no worker holds a unit");
  } else {
    fmt::print(
        "rate        at most {:.2f} units/s, if each worker has a core of its own (--over 30s measures)",
        s.rate);
    if (std::isfinite(s.remaining) && s.remaining > 0.0)
      fmt::print(", at least {:.1f} min left", s.remaining / 60.0);
  }
  fmt::print("\n");
}

struct StatusChoice {
  std::string store;
  int failures = 5;
  std::string over;  ///< empty: no measurement
};

void print_status(const StatusChoice& choice) {
  const double over = choice.over.empty() ? 0.0 : parse_seconds("--over", choice.over);
  const auto store = open_to_read(choice.store);
  std::int64_t before = 0;
  if (over > 0.0) {
    const StoreCounts first = store->counts();
    before = first.done + first.failed;
    std::this_thread::sleep_for(std::chrono::duration<double>(over));
  }
  const BuildStatus s = compute_status(*store, seconds_since_1970());
  const StoreCounts& c = s.counts;
  const std::int64_t units = c.done + c.failed + c.claimed + c.waiting;
  fmt::print("{}: {} of {} units have ended ({:.1f} %), {} of them failed; {} are claimed, {} wait\n",
             store->place(), c.done + c.failed, units,
             100.0 * mean(static_cast<double>(c.done + c.failed), units), c.failed, c.claimed, c.waiting);
  fmt::print("grasps      {}, {:.1f} a unit\n", c.grasps,
             mean(static_cast<double>(c.grasps), c.done + c.failed));
  print_rate(s, over, c.done + c.failed - before);
  for (const ActiveHost& h : s.hosts)
    fmt::print("host        {}: {} workers hold {} units, {} have ended there\n", h.host, h.workers,
               h.claimed, h.ended);
  const auto shown = std::min(static_cast<std::size_t>(choice.failures), s.failures.size());
  for (std::size_t i = s.failures.size() - shown; i < s.failures.size(); ++i)
    fmt::print("failed      {}: {}\n", describe(s.failures[i].first), s.failures[i].second);
}

void print_stats(const std::string& address) {
  const auto store = open_to_read(address);
  const StoreStatistics s = compute_statistics(*store);
  fmt::print("{}: {} objects, {} of them without any grasp\n", store->place(), s.objects,
             s.objects_without_grasps);
  fmt::print("{:<20} {:>8} {:>8} {:>9} {:>8} {:>9} {:>9} {:>27}\n", "hand", "units", "failed", "grasps",
             "a unit", "s a unit", "median s", "epsilon 10 %, 50 %, 90 %");
  HandStatistics all;
  for (const HandStatistics& h : s.hands) {
    fmt::print("{:<20} {:>8} {:>8} {:>9} {:>8.1f} {:>9.2f} {:>9.2f} {:>9.4f}{:>9.4f}{:>9.4f}\n", h.hand,
               h.units, h.failed, h.form_closed, mean(static_cast<double>(h.form_closed), h.done + h.failed),
               mean(h.seconds, h.done + h.failed), h.median_seconds, quantile(h.epsilons, 0.1),
               quantile(h.epsilons, 0.5), quantile(h.epsilons, 0.9));
    all.units += h.units;
    all.failed += h.failed;
    all.form_closed += h.form_closed;
    all.seconds += h.seconds;
    all.done += h.done;
  }
  fmt::print("{:<20} {:>8} {:>8} {:>9} {:>8.1f} {:>9.2f}\n", "all", all.units, all.failed, all.form_closed,
             mean(static_cast<double>(all.form_closed), all.done + all.failed),
             mean(all.seconds, all.done + all.failed));
  fmt::print("{:.2f} core-hours; {} units ended at the time limit\n", all.seconds / 3600.0, s.limited);
  for (const FailureStatistics& f : s.failures)
    fmt::print("failed      {:>6} units: {}; such as {}: {}\n", f.units, f.kind, describe(f.example),
               f.reason);
}

}  // namespace

void add_db_status(CLI::App& db) {
  CLI::App* status = db.add_subcommand("status", "Progress of a build, rate, failures, who works on it");
  auto choice = std::make_shared<StatusChoice>();
  status->add_option("store", choice->store, kStoreToReadHelp)->required();
  status->add_option("--failures", choice->failures, "Failed units to name (default: 5)")
      ->check(CLI::NonNegativeNumber);
  status->add_option("--over", choice->over,
                     "Measure the rate for so long, such as 30s (default: not at all)");
  status->footer("Example:\n  eigengrasp db status sqlite:grasps.db --over 30s");
  status->callback([choice] { print_status(*choice); });
}

void add_db_stats(CLI::App& db) {
  CLI::App* stats =
      db.add_subcommand("stats", "Grasps of each hand, their epsilon, units without grasps and why, time");
  auto store = std::make_shared<std::string>();
  stats->add_option("store", *store, kStoreToReadHelp)->required();
  stats->footer("Example:\n  eigengrasp db stats sqlite:grasps.db");
  stats->callback([store] { print_stats(*store); });
}

}  // namespace eigengrasp::cli
