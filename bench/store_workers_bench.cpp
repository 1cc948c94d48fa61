// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Where a store saturates: 1 to 64 workers with a connection each, which claim a unit of work and at once
// hand in 25 grasps for it. units/s is of all workers together; a worker that plans needs one claim and one
// result for some tenths of a second of planning. All on this machine: the workers' own part of the time
// counts too.
#include <benchmark/benchmark.h>

#include <map>
#include <mutex>

#include "eigengrasp/core/temporary_folder.hpp"
#include "eigengrasp/database/grasp_store.hpp"
#include "support/postgres_server.hpp"
#include "support/random_grasps.hpp"

namespace {

using namespace eigengrasp;
using eigengrasp::testing::PostgresServer;
using eigengrasp::testing::RandomGrasps;
using eigengrasp::testing::stored_hand;

constexpr int kObjects = 20;
constexpr int kScalesOfObject = 2000;
constexpr std::size_t kGraspsOfUnit = 25;
const std::string kHand = "human";

/// A store with many units that wait.
class WaitingUnits {
 public:
  explicit WaitingUnits(const std::string& kind)
      : address_(kind == "sqlite" ? "sqlite:" + folder_.path().string() + "/g.db"
                                  : PostgresServer::instance()->make_database()) {
    const auto store = open_store(address_);
    store->add_hand(stored_hand(kHand));
    store->add_source({"planner", ""});
    for (int o = 0; o < kObjects; ++o) {
      StoredModel model;
      model.name = "psb_" + std::to_string(o);
      model.scales.clear();
      std::vector<UnitKey> keys;
      for (int s = 1; s <= kScalesOfObject; ++s) {
        model.scales.push_back(0.001 * s);
        keys.push_back({model.name, 0.001 * s, kHand});
      }
      store->add_model(model);
      store->add_units(keys);
    }
  }
  const std::string& address() const { return address_; }

  /// The store of a kind, made when it is first asked for.
  static const WaitingUnits& of(const std::string& kind) {
    static std::mutex mutex;
    static std::map<std::string, std::unique_ptr<WaitingUnits>> all;
    const std::scoped_lock lock(mutex);
    auto& units = all[kind];
    if (!units) units = std::make_unique<WaitingUnits>(kind);
    return *units;
  }

 private:
  TemporaryFolder folder_{"workers"};
  std::string address_;
};

void claim_and_finish(benchmark::State& state, const std::string& kind) {
  if (kind == "postgresql" && !PostgresServer::instance()) {
    state.SkipWithError(PostgresServer::why_none());
    return;
  }
  StoreOptions options;
  options.lock_seconds = 60.0;
  const auto store = open_store(WaitingUnits::of(kind).address(), options);
  const std::string worker = "worker " + std::to_string(state.thread_index());
  UnitResult result;
  result.grasps = RandomGrasps(1).grasps({"", 1.0, kHand}, stored_hand(kHand), kGraspsOfUnit);
  std::int64_t units = 0;
  for (auto _ : state) {
    const auto key = store->claim_unit(worker, 3600.0);
    if (!key) {
      state.SkipWithError("no unit left");
      break;
    }
    result.key = *key;
    for (StoredGrasp& g : result.grasps) {
      g.grasp.object = key->object;
      g.grasp.object_scale = key->scale;
      g.grasp.hand = key->hand;
    }
    units += store->finish_unit(result);
  }
  state.counters["units"] = benchmark::Counter(static_cast<double>(units), benchmark::Counter::kIsRate);
  state.counters["grasps"] = benchmark::Counter(
      static_cast<double>(kGraspsOfUnit) * static_cast<double>(units), benchmark::Counter::kIsRate);
}

}  // namespace

#define WORKERS_BENCHMARK(kind)                    \
  BENCHMARK_CAPTURE(claim_and_finish, kind, #kind) \
      ->Unit(benchmark::kMillisecond)              \
      ->UseRealTime()                              \
      ->MinTime(2.0)                               \
      ->Threads(1)                                 \
      ->Threads(4)                                 \
      ->Threads(16)                                \
      ->Threads(64)
WORKERS_BENCHMARK(postgresql);
WORKERS_BENCHMARK(sqlite);
