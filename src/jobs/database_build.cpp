// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/database_build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "eigengrasp/core/core_watch.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/jobs/worker_name.hpp"

namespace eigengrasp {

std::vector<std::string> BuildOptions::validate() const {
  std::vector<std::string> violations = unit.validate();
  if (hands.empty()) violations.emplace_back("hands is empty, expected at least one");
  if (scales.empty()) violations.emplace_back("scales is empty, expected at least one");
  double last = 0.0;
  for (const double scale : scales) {
    if (!(scale > last) || !std::isfinite(scale))
      violations.push_back(
          fmt::format("scales holds {} behind {}, expected ascending numbers above 0", scale, last));
    last = scale;
  }
  if (jobs < 0 || jobs > 4096)
    violations.push_back(fmt::format("jobs is {}, expected 0 (all) to 4096", jobs));
  if (!(lease >= 0.0) || !(lease <= 1e9))
    violations.push_back(fmt::format("lease is {} s, expected 0 (by the time limit) to 1e9", lease));
  for (const auto& hand : hands)
    for (const std::string& v : PlanOptions{.amplitudes = std::min(2, hand->n_dof())}.validate(*hand))
      violations.push_back(v);
  return violations;
}

/// Hands, the source and all units that are not there yet: those of an object together.
void add_work(GraspStore& store, const BuildOptions& options) {
  std::vector<UnitKey> keys;
  for (const auto& hand : options.hands) store.add_hand(hand_record(*hand));
  store.add_source(builder_source());
  for (StoredModel model : store.models()) {
    std::set<double> scales(model.scales.begin(), model.scales.end());
    scales.insert(options.scales.begin(), options.scales.end());
    if (scales.size() > model.scales.size()) {
      model.scales.assign(scales.begin(), scales.end());
      store.add_model(model);
    }
    for (const double scale : options.scales)
      for (const auto& hand : options.hands) keys.push_back({model.name, scale, hand->name});
  }
  store.add_units(keys);
  if (options.retry_failed) store.reopen_failed_units();
}

namespace {

class Build {
 public:
  Build(GraspStore& store, const BuildOptions& options) : store_(store), options_(options) {
    for (const StoredModel& m : store.models()) models_.emplace(m.name, m);
  }

  BuildReport run();

 private:
  bool wait_for_others(const std::string& worker);
  bool give_back(const std::string& worker);
  void require_hands();
  void work(int thread);
  void build_object(const std::vector<UnitKey>& keys, const std::string& worker);
  std::optional<UnitResult> build_unit(const UnitKey& key, std::unique_ptr<PreparedObject>& object);
  void count(const UnitResult& result);
  bool stopped() const { return options_.stop != nullptr && options_.stop->stop_requested(); }
  /// A unit takes no more than its time limit and the preparation of its object.
  double lease_seconds() const {
    return options_.lease > 0.0 ? options_.lease : 3.0 * options_.unit.time_limit + 120.0;
  }

  GraspStore& store_;
  const BuildOptions& options_;
  std::map<std::string, StoredModel> models_;
  std::map<std::string, PreparedHand> hands_;
  std::atomic<bool> broken_{false};  ///< the store, for one of the threads
  std::mutex counting_;
  BuildProgress progress_;
  StopWatch watch_;
};

/// What processes of this machine held that have ended waits again, and what this worker, which has nothing
/// in hand, holds by a claim whose answer was lost. @returns whether there was any
bool Build::give_back(const std::string& worker) {
  bool any = false;
  for (const StoredUnit& u : store_.claimed_units())
    if (u.worker == worker || has_ended_here(u.worker)) any = store_.release_unit(u.key, u.worker) || any;
  return any;
}

void Build::require_hands() {
  for (const StoredUnit& u : store_.units()) {
    const bool ended = u.state == UnitState::done || u.state == UnitState::failed;
    if (!ended && !hands_.contains(u.key.hand))
      fail("{}: units wait for the hand '{}', which is not among the given ones", store_.place(), u.key.hand);
    ++progress_.units;
    if (ended) ++progress_.ended;
  }
}

/// Of what was stored. A unit that two have worked out, as after a crash of the server that forgot a claim,
/// is stored once.
void Build::count(const UnitResult& result) {
  const std::scoped_lock lock(counting_);
  ++progress_.ended;
  ++progress_.ended_now;
  progress_.grasps_now += static_cast<std::int64_t>(result.grasps.size());
  if (result.state == UnitState::failed) ++progress_.failed_now;
  progress_.seconds = watch_.seconds();
  if (options_.progress) options_.progress(progress_);
}

/// What cannot be planned fails with the reason; only a store that fails ends the build.
std::optional<UnitResult> Build::build_unit(const UnitKey& key, std::unique_ptr<PreparedObject>& object) {
  const CoreWatch watch;
  try {
    if (!object) object = std::make_unique<PreparedObject>(models_.at(key.object));
    const double preparation = watch.seconds();
    std::optional<UnitResult> result =
        plan_unit(key, hands_.at(key.hand), *object, options_.unit, options_.stop);
    if (result) result->seconds += preparation;
    return result;
  } catch (const std::exception& e) {
    UnitResult failed;
    failed.key = key;
    failed.state = UnitState::failed;
    failed.reason = e.what();
    failed.seconds = watch.seconds();
    return failed;
  }
}

void Build::build_object(const std::vector<UnitKey>& keys, const std::string& worker) {
  std::unique_ptr<PreparedObject> object;
  StopWatch since_renewal;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (since_renewal.seconds() > lease_seconds() / 4.0) {
      for (std::size_t k = i; k < keys.size(); ++k) store_.renew_lease(keys[k], worker, lease_seconds());
      since_renewal.lap();
    }
    std::optional<UnitResult> result;
    if (!stopped() && !broken_) result = build_unit(keys[i], object);
    if (!result) {
      store_.release_unit(keys[i], worker);
      continue;
    }
    result->worker = worker;
    if (store_.finish_unit(*result)) count(*result);
  }
}

/// What others hold comes back when they give it up or their leases end. @returns false where nothing is held
bool Build::wait_for_others(const std::string& worker) {
  constexpr int naps = 20;
  constexpr auto nap = std::chrono::milliseconds(100);
  if (give_back(worker)) return true;
  const StoreCounts counts = store_.counts();
  if (counts.claimed == 0) return counts.waiting > 0;
  for (int i = 0; i < naps && !stopped() && !broken_; ++i) std::this_thread::sleep_for(nap);
  return true;
}

void Build::work(int thread) {
  const std::string worker = worker_name(thread);
  try {
    while (!stopped() && !broken_) {
      const std::vector<UnitKey> keys = store_.claim_object(worker, lease_seconds());
      if (!keys.empty()) {
        build_object(keys, worker);
      } else if (!wait_for_others(worker)) {
        return;
      }
    }
  } catch (...) {
    broken_ = true;
    throw;
  }
}

BuildReport Build::run() {
  if (!options_.only_waiting) add_work(store_, options_);
  give_back("");
  for (const auto& hand : options_.hands)
    hands_[hand->name] = prepare_hand(hand, options_.jobs, options_.cache.get());
  require_hands();
  const int jobs = options_.jobs > 0 ? options_.jobs : hardware_threads();
  parallel_for(static_cast<std::size_t>(jobs), jobs, [&](std::size_t i, int) { work(static_cast<int>(i)); });
  progress_.seconds = watch_.seconds();
  const StoreCounts counts = store_.counts();  // with what others have ended
  progress_.ended = counts.done + counts.failed;
  return {progress_, stopped()};
}

}  // namespace

BuildReport build_database(GraspStore& store, const BuildOptions& options) {
  if (const auto violations = options.validate(); !violations.empty()) throw Error(violations.front());
  return Build(store, options).run();
}

}  // namespace eigengrasp
