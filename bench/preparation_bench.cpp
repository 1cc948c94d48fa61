// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// What is made once of an object and of a hand, on one thread: distance fields, inner spheres of all links,
// and the same from the cache on disk.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include "eigengrasp/geometry/preparation_cache.hpp"
#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace {

using namespace eigengrasp;
namespace fs = std::filesystem;

constexpr double tolerance = 0.0007;  // [m] of the inner spheres

struct CacheFolder {
  fs::path path = fs::temp_directory_path() / ("eigengrasp_bench." + std::to_string(::getpid()));
  ~CacheFolder() { fs::remove_all(path); }
};

DistanceFieldOptions on_one_thread() {
  DistanceFieldOptions options;
  options.threads = 1;
  return options;
}

void make_field(benchmark::State& state, const char* name) {
  const ObjectModel object = load_object(find_object(name));
  for (auto _ : state) {
    const DistanceField field(object.bvh, on_one_thread());
    benchmark::DoNotOptimize(field.grids().get());
    state.counters["nodes"] = static_cast<double>(field.fine().values.size() + field.coarse().values.size());
  }
}

void load_field(benchmark::State& state, const char* name) {
  const CacheFolder folder;
  const ObjectModel object = load_object(find_object(name));
  PreparationCache({.folder = folder.path}).object_field(object, on_one_thread());
  for (auto _ : state) {
    const DistanceField field = PreparationCache({.folder = folder.path}).object_field(object, {});
    benchmark::DoNotOptimize(field.grids().get());
  }
}

void cover_hand(benchmark::State& state, const char* name) {
  const HandModel hand = load_hand(find_hand(name));
  for (auto _ : state) {
    std::size_t count = 0;
    for (const HandLink& link : hand.links)
      count += cover_with_inner_spheres(link.mesh, MeshBvh(link.mesh), tolerance).size();
    state.counters["spheres"] = static_cast<double>(count);
  }
}

void prepare_hand(benchmark::State& state, const char* name, bool cached) {
  const CacheFolder folder;
  const HandModel hand = load_hand(find_hand(name));
  PreparationCache cache({.folder = folder.path});
  if (cached) HandSurfaces(hand, tolerance, 1, &cache);
  for (auto _ : state) {
    PreparationCache anew({.folder = folder.path});
    benchmark::DoNotOptimize(HandSurfaces(hand, tolerance, 1, cached ? &anew : nullptr).links.data());
  }
}

BENCHMARK_CAPTURE(make_field, glass, "glass")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(make_field, shoe, "shoe")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load_field, shoe, "shoe")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cover_hand, human, "human")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(prepare_hand, human, "human", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(prepare_hand, human_cached, "human", true)->Unit(benchmark::kMillisecond);

}  // namespace
