// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Epsilon and closure of 64 random sets of contacts on an ellipsoid the size of a hand, torques over 50 mm,
// mu 0.5. The time is that of one set; closed and epsilon (means) tell whether the results are still the
// same.
#include <benchmark/benchmark.h>

#include "support/random_contacts.hpp"

namespace {

using namespace eigengrasp;

constexpr std::size_t kSets = 64;

std::vector<std::vector<ContactPoint>> make_sets(const benchmark::State& state) {
  std::vector<std::vector<ContactPoint>> sets;
  for (std::uint64_t seed = 0; seed < kSets; ++seed) {
    sets.push_back(eigengrasp::testing::random_contacts(static_cast<int>(state.range(0)), 0.5,
                                                        1e-3 * static_cast<double>(state.range(1)), seed));
  }
  return sets;
}

void report(benchmark::State& state, const std::vector<std::vector<ContactPoint>>& sets,
            const WrenchSpaceOptions& options) {
  for (const auto& contacts : sets) {
    const WrenchSpaceQuality q = compute_epsilon(contacts, options);
    state.counters["epsilon"] += q.epsilon / kSets;
    state.counters["closed"] += q.form_closure;
  }
}

void run_epsilon(benchmark::State& state, const WrenchSpaceOptions& options) {
  const auto sets = make_sets(state);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(compute_epsilon(sets[i++ % kSets], options).epsilon);
  report(state, sets, options);
}

void epsilon_edges(benchmark::State& state) {
  run_epsilon(state, eigengrasp::testing::hand_options());
}

void epsilon_exact(benchmark::State& state) {
  auto options = eigengrasp::testing::hand_options();
  options.cone = ConeModel::exact;
  run_epsilon(state, options);
}

void epsilon_linf(benchmark::State& state) {
  auto options = eigengrasp::testing::hand_options();
  options.norm = WrenchNorm::linf;
  run_epsilon(state, options);
}

void closure(benchmark::State& state) {
  const auto options = eigengrasp::testing::hand_options();
  const auto sets = make_sets(state);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(has_form_closure(sets[i++ % kSets], options));
  report(state, sets, options);
}

void volume(benchmark::State& state) {
  const auto sets = make_sets(state);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(compute_volume(sets[i++ % kSets], eigengrasp::testing::hand_options()));
  }
}

}  // namespace

// Arguments: contacts, torsion length in millimetres (0: point contacts with 8 edges, else soft ones with
// 20).
BENCHMARK(epsilon_edges)
    ->Args({3, 0})
    ->Args({4, 0})
    ->Args({8, 0})
    ->Args({12, 0})
    ->Args({8, 3})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(epsilon_exact)
    ->Args({3, 0})
    ->Args({4, 0})
    ->Args({8, 0})
    ->Args({8, 3})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(epsilon_linf)->Args({4, 0})->Args({8, 0})->Unit(benchmark::kMicrosecond);
BENCHMARK(closure)->Args({3, 0})->Args({4, 0})->Args({8, 0})->Args({12, 0})->Args({8, 3})->Unit(
    benchmark::kMicrosecond);
BENCHMARK(volume)->Args({8, 0})->Unit(benchmark::kMicrosecond);
