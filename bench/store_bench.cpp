// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Grasp stores of 250,000 grasps of a hand with 20 joints and 10 contacts: 1,250 objects, four scales, two
// hands, 25 grasps a unit. insert: units stored 1 or 40 a transaction (items are grasps; the disk is waited
// for as always). load: all 100 grasps of an object and hand, and found counts them. claim: a unit of work
// among 10,000. EIGENGRASP_BENCH_GRASPS: another number of grasps.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>

#include "eigengrasp/core/temporary_folder.hpp"
#include "eigengrasp/database/grasp_store.hpp"
#include "support/postgres_server.hpp"
#include "support/random_grasps.hpp"

namespace {

using namespace eigengrasp;
using eigengrasp::testing::PostgresServer;
using eigengrasp::testing::RandomGrasps;
using eigengrasp::testing::stored_hand;

constexpr std::size_t kGraspsOfUnit = 25;
const std::vector<double> kScales = {0.75, 1.0, 1.25, 1.5};
const std::vector<std::string> kHands = {"human", "barrett"};

std::size_t wanted_grasps() {
  const char* text = std::getenv("EIGENGRASP_BENCH_GRASPS");
  return text ? std::strtoul(text, nullptr, 10) : 250000;
}

/// The store of a kind, filled as it is timed: first by insert, then to the wanted number.
class BenchStore {
 public:
  explicit BenchStore(const std::string& kind) {
    const std::string name = folder_.path().string();
    store_ = open_store(kind == "sqlite" ? "sqlite:" + name + "/g.db"
                        : kind == "text" ? "text:" + name + "/g"
                                         : PostgresServer::instance()->make_database());
    for (const std::string& hand : kHands) store_->add_hand(stored_hand(hand));
    store_->add_source({"planner", ""});
    grasps_ = RandomGrasps(1).grasps({"", 1.0, kHands[0]}, stored_hand(kHands[0]), 500);
  }

  GraspStore& store() { return *store_; }
  std::size_t size() const { return kGraspsOfUnit * units_; }
  static std::string object(std::size_t i) { return "psb_" + std::to_string(i); }

  /// The next units, with their objects in the store.
  std::vector<UnitResult> next_units(std::size_t n) {
    std::vector<UnitResult> results;
    for (std::size_t i = 0; i < n; ++i, ++units_) {
      const std::size_t per_object = kScales.size() * kHands.size();
      UnitResult r;
      r.key = {object(units_ / per_object), kScales[units_ / 2 % 4], kHands[units_ % 2]};
      if (units_ % per_object == 0) {
        StoredModel model;
        model.name = r.key.object;
        store_->add_model(model);
      }
      for (std::size_t k = 0; k < kGraspsOfUnit; ++k) {
        StoredGrasp& g = r.grasps.emplace_back(grasps_[(units_ * 7 + k) % grasps_.size()]);
        g.grasp.object = r.key.object;
        g.grasp.object_scale = r.key.scale;
        g.grasp.hand = r.key.hand;
      }
      results.push_back(std::move(r));
    }
    return results;
  }
  void fill() {
    while (size() < wanted_grasps()) store_->finish_units(next_units(80));
  }

 private:
  TemporaryFolder folder_{"bench"};  ///< before the store in it
  std::unique_ptr<GraspStore> store_;
  std::vector<StoredGrasp> grasps_;
  std::size_t units_ = 0;
};

BenchStore* bench_store(benchmark::State& state, const std::string& kind) {
  static std::map<std::string, std::unique_ptr<BenchStore>> stores;
  if (kind == "postgresql" && !PostgresServer::instance()) {
    state.SkipWithError(PostgresServer::why_none());
    return nullptr;
  }
  auto& store = stores[kind];
  if (!store) store = std::make_unique<BenchStore>(kind);
  return store.get();
}

void insert(benchmark::State& state, const std::string& kind) {
  BenchStore* bench = bench_store(state, kind);
  if (!bench) return;
  const auto n = static_cast<std::size_t>(state.range(0));
  std::int64_t grasps = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const auto units = bench->next_units(n);
    state.ResumeTiming();
    const auto stored = bench->store().finish_units(units);
    grasps += kGraspsOfUnit * std::count(stored.begin(), stored.end(), true);
  }
  state.SetItemsProcessed(grasps);
}

void load(benchmark::State& state, const std::string& kind) {
  BenchStore* bench = bench_store(state, kind);
  if (!bench) return;
  bench->fill();
  const std::size_t objects = bench->size() / (kGraspsOfUnit * kScales.size() * kHands.size());
  std::size_t i = 0, found = 0;
  for (auto _ : state) {
    ++i;
    const auto grasps = bench->store().grasps(BenchStore::object(i * 7919 % objects), kHands[i % 2]);
    found += grasps.size();
  }
  state.counters["found"] =
      benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
  state.counters["of"] = static_cast<double>(bench->size());
}

void claim(benchmark::State& state, const std::string& kind) {
  BenchStore* bench = bench_store(state, kind);
  if (!bench) return;
  StoredModel model;
  model.name = "many";
  model.scales.clear();
  std::vector<UnitKey> keys;
  for (int i = 1; i <= 10000; ++i) {
    model.scales.push_back(0.001 * i);
    keys.push_back({"many", 0.001 * i, kHands[0]});
  }
  bench->store().add_model(model);
  bench->store().add_units(keys);
  for (auto _ : state)
    if (!bench->store().claim_unit("bench", 3600.0)) state.SkipWithError("no unit left");
}

}  // namespace

#define STORE_BENCHMARKS(kind)                                                                           \
  BENCHMARK_CAPTURE(insert, kind, #kind)->Arg(1)->Arg(40)->Unit(benchmark::kMillisecond)->UseRealTime(); \
  BENCHMARK_CAPTURE(load, kind, #kind)->Unit(benchmark::kMillisecond)->UseRealTime();                    \
  BENCHMARK_CAPTURE(claim, kind, #kind)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1000)
STORE_BENCHMARKS(sqlite);
STORE_BENCHMARKS(postgresql);
