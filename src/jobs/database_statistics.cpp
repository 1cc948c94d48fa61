// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/database_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "eigengrasp/jobs/worker_name.hpp"

namespace eigengrasp {

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0.0;
  const auto place = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5);
  return sorted[std::min(place, sorted.size() - 1)];
}

namespace {

bool has_ended(const StoredUnit& u) {
  return u.state == UnitState::done || u.state == UnitState::failed;
}

std::string kind_of(const std::string& reason) {
  const std::size_t limit = reason.find("; ");
  const bool limited = reason.starts_with("the time limit") && limit != std::string::npos;
  const std::string told = limited ? reason.substr(limit + 2) : reason;
  const std::string kind = told.substr(0, told.find(':'));
  return (limited ? "time limit, " : "") + (kind.find('/') == std::string::npos ? kind : "bad geometry");
}

void add_failure(const StoredUnit& u, std::map<std::string, FailureStatistics>& kinds) {
  FailureStatistics& f = kinds[kind_of(u.reason)];
  if (f.units++ > 0) return;
  f.kind = kind_of(u.reason);
  f.example = u.key;
  f.reason = u.reason;
}

void add_units(const std::vector<StoredUnit>& units, StoreStatistics& statistics) {
  std::map<std::string, FailureStatistics> kinds;
  for (HandStatistics& h : statistics.hands) {
    std::vector<double> seconds;
    for (const StoredUnit& u : units) {
      if (u.key.hand != h.hand) continue;
      ++h.units;
      if (!has_ended(u)) continue;
      ++(u.state == UnitState::done ? h.done : h.failed);
      h.seconds += u.seconds;
      seconds.push_back(u.seconds);
      if (u.reason.starts_with("the time limit")) ++statistics.limited;
      if (u.state == UnitState::failed) add_failure(u, kinds);
    }
    std::sort(seconds.begin(), seconds.end());
    h.median_seconds = quantile(seconds, 0.5);
  }
  for (auto& [kind, failure] : kinds) statistics.failures.push_back(failure);
  std::stable_sort(statistics.failures.begin(), statistics.failures.end(),
                   [](const FailureStatistics& a, const FailureStatistics& b) { return a.units > b.units; });
}

}  // namespace

StoreStatistics compute_statistics(GraspStore& store) {
  StoreStatistics statistics;
  for (const StoredHand& h : store.hands()) {
    statistics.hands.emplace_back();
    statistics.hands.back().hand = h.name;
  }
  const std::vector<StoredUnit> units = store.units();
  add_units(units, statistics);
  std::set<std::string> pending;
  for (const StoredUnit& u : units)
    if (!has_ended(u)) pending.insert(u.key.object);
  for (const StoredModel& m : store.models()) {
    ++statistics.objects;
    std::int64_t of_object = 0;
    for (HandStatistics& h : statistics.hands)
      for (const StoredGrasp& g : store.grasps(m.name, h.hand)) {
        ++of_object;
        ++h.grasps;
        if (!g.grasp.form_closure) continue;
        ++h.form_closed;
        h.epsilons.push_back(g.grasp.epsilon);
      }
    if (of_object == 0 && !pending.contains(m.name)) ++statistics.objects_without_grasps;
  }
  for (HandStatistics& h : statistics.hands) std::sort(h.epsilons.begin(), h.epsilons.end());
  return statistics;
}

BuildStatus compute_status(GraspStore& store, double now) {
  BuildStatus status;
  status.counts = store.counts();
  std::map<std::string, ActiveHost> hosts;
  std::map<std::string, std::set<std::string>> workers;
  double seconds = 0.0;
  for (const StoredUnit& u : store.units()) {
    if (u.worker.empty()) continue;
    const std::string host = host_of_worker(u.worker);
    ActiveHost& active = hosts[host];
    active.host = host;
    if (has_ended(u)) {
      ++active.ended;
      seconds += u.seconds;
    } else if (u.lease_until >= now && !has_ended_here(u.worker)) {
      ++active.claimed;
      workers[host].insert(u.worker);
    }
    if (u.state == UnitState::failed) status.failures.emplace_back(u.key, u.reason);
  }
  std::size_t n_workers = 0;
  for (auto& [name, host] : hosts) {
    host.workers = static_cast<int>(workers[name].size());
    n_workers += workers[name].size();
    status.hosts.push_back(host);
  }
  const auto ended = static_cast<double>(status.counts.done + status.counts.failed);
  const auto left = static_cast<double>(status.counts.waiting + status.counts.claimed);
  if (ended > 0.0) status.mean_seconds = seconds / ended;
  if (status.mean_seconds > 0.0) status.rate = static_cast<double>(n_workers) / status.mean_seconds;
  status.remaining = status.rate > 0.0 ? left / status.rate
                     : left > 0.0      ? std::numeric_limits<double>::infinity()
                                       : 0.0;
  return status;
}

}  // namespace eigengrasp
