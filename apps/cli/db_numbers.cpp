// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// eigengrasp db status, stats
#include <fmt/core.h>

#include <chrono>
#include <cmath>

#include "cli/db_parts.hpp"
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

void print_status(const std::string& address, int n_failures) {
  const auto store = open_to_read(address);
  const BuildStatus s = compute_status(*store, seconds_since_1970());
  const StoreCounts& c = s.counts;
  const std::int64_t units = c.done + c.failed + c.claimed + c.waiting;
  fmt::print("{}: {} of {} units have ended ({:.1f} %), {} of them failed; {} are claimed, {} wait\n",
             store->place(), c.done + c.failed, units,
             100.0 * mean(static_cast<double>(c.done + c.failed), units), c.failed, c.claimed, c.waiting);
  fmt::print("grasps      {}, {:.1f} a unit\n", c.grasps,
             mean(static_cast<double>(c.grasps), c.done + c.failed));
  fmt::print("rate        {:.2f} units/s where each worker has a core, {:.2f} core-seconds a unit", s.rate,
             s.mean_seconds);
  if (std::isfinite(s.remaining) && s.remaining > 0.0) fmt::print(", {:.1f} min left", s.remaining / 60.0);
  fmt::print("\n");
  for (const ActiveHost& h : s.hosts)
    fmt::print("host        {}: {} workers hold {} units, {} have ended there\n", h.host, h.workers,
               h.claimed, h.ended);
  const auto shown = std::min(static_cast<std::size_t>(n_failures), s.failures.size());
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
  auto store = std::make_shared<std::string>();
  auto failures = std::make_shared<int>(5);
  status->add_option("store", *store, kStoreHelp)->required();
  status->add_option("--failures", *failures, "Failed units to name (default: 5)")
      ->check(CLI::NonNegativeNumber);
  status->footer("Example:\n  eigengrasp db status sqlite:grasps.db");
  status->callback([store, failures] { print_status(*store, *failures); });
}

void add_db_stats(CLI::App& db) {
  CLI::App* stats =
      db.add_subcommand("stats", "Grasps of each hand, their epsilon, units without grasps and why, time");
  auto store = std::make_shared<std::string>();
  stats->add_option("store", *store, kStoreHelp)->required();
  stats->footer("Example:\n  eigengrasp db stats sqlite:grasps.db");
  stats->callback([store] { print_stats(*store); });
}

}  // namespace eigengrasp::cli
