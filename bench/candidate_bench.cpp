// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// What becomes of a pre-grasp, step by step, each with what the one before hands over: the human hand and the
// glass, shipped or, where the variable EIGENGRASP_BENCH_GRASPIT names GraspIt!'s folder, those of GraspIt!,
// and the best pre-grasps of a short search with a fixed seed. The time is that of one candidate; the means
// contacts, closed, epsilon and legal tell whether the results are still the same.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <functional>

#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/paper_models.hpp"
#include "eigengrasp/planning/finger_closing.hpp"
#include "eigengrasp/planning/palm_approach.hpp"
#include "planning/candidate_test.hpp"

namespace {

using namespace eigengrasp;

/// A pre-grasp and what each step makes of it.
struct Candidate {
  PreGrasp pregrasp;
  ClosedHand closed;
  std::vector<GraspContact> contacts;
  std::vector<ContactPoint> points;
};

struct Bench {
  Scene scene;
  std::unique_ptr<CollisionModel> model;
  std::unique_ptr<GraspEnergy> energy;
  std::vector<Candidate> candidates;
};

Scene human_and_glass() {
  const char* graspit = std::getenv("EIGENGRASP_BENCH_GRASPIT");
  const ModelSource source = graspit != nullptr ? find_graspit_models(graspit) : ModelSource{};
  Scene scene;
  scene.hand = std::make_shared<const HandModel>(load_paper_hand(source, PaperHand::human));
  scene.object = std::make_shared<const ObjectModel>(load_paper_object(source, PaperObject::glass));
  scene.object_material.name = scene.object->material;
  return scene;
}

Bench make_bench() {
  Bench bench;
  bench.scene = human_and_glass();
  PlanOptions options;
  options.iterations = 20000;
  options.grasps = 40;
  bench.model = std::make_unique<CollisionModel>(bench.scene, CollisionModel::Options{});
  bench.energy = std::make_unique<GraspEnergy>(*bench.model, options);
  for (const Grasp& g : plan_grasps(bench.scene, options).grasps) {
    Candidate c;
    c.pregrasp.X_OH = g.X_OH_pregrasp;
    c.pregrasp.dofs = g.pregrasp_dofs;
    c.closed = close_fingers(*bench.model, c.pregrasp.X_OH, c.pregrasp.dofs);
    c.contacts = find_contacts(*bench.model, c.closed.X_OL);
    for (const GraspContact& contact : c.contacts) c.points.push_back(contact.point);
    bench.candidates.push_back(std::move(c));
  }
  return bench;
}

const Bench& shared_bench() {
  static const Bench bench = make_bench();
  return bench;
}

void run(benchmark::State& state, const std::function<void(const Bench&, const Candidate&)>& step) {
  const Bench& bench = shared_bench();
  std::size_t i = 0;
  for (auto _ : state) step(bench, bench.candidates[i++ % bench.candidates.size()]);
  const auto share = 1.0 / static_cast<double>(bench.candidates.size());
  for (const Candidate& c : bench.candidates) {
    const WrenchSpaceQuality quality = compute_epsilon(c.points, bench.energy->wrench_space());
    state.counters["contacts"] += share * static_cast<double>(c.points.size());
    state.counters["closed"] += quality.form_closure;
    state.counters["epsilon"] += share * quality.epsilon;
    state.counters["legal"] += share * (bench.model->check_exact(c.closed.X_OL) == Legality::legal);
  }
}

void closing(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    benchmark::DoNotOptimize(close_fingers(*b.model, c.pregrasp.X_OH, c.pregrasp.dofs).joints.data());
  });
}

void contacts(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    benchmark::DoNotOptimize(find_contacts(*b.model, c.closed.X_OL, {}, &c.closed.proximity).data());
  });
}

void closure(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    benchmark::DoNotOptimize(has_form_closure(c.points, b.energy->wrench_space()));
  });
}

void epsilon(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    benchmark::DoNotOptimize(compute_epsilon(c.points, b.energy->wrench_space()).epsilon);
  });
}

void deepest_penetration(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    benchmark::DoNotOptimize(b.model->deepest_penetration(c.closed.X_OL, &c.closed.proximity));
  });
}

void exactly_legal(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    PreGrasp pregrasp = c.pregrasp;
    benchmark::DoNotOptimize(make_exactly_legal(*b.model, *b.energy, pregrasp));
  });
}

void palm_approach(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    const VecX joints = joint_values(*b.scene.hand, c.pregrasp.dofs);
    benchmark::DoNotOptimize(approach_until_contact(*b.model, c.pregrasp.X_OH, joints, 0.03).travel);
  });
}

void whole_candidate(benchmark::State& state) {
  run(state, [](const Bench& b, const Candidate& c) {
    benchmark::DoNotOptimize(test_candidate(*b.model, *b.energy, c.pregrasp).grasp.epsilon);
  });
}

}  // namespace

BENCHMARK(closing)->Unit(benchmark::kMicrosecond);
BENCHMARK(contacts)->Unit(benchmark::kMicrosecond);
BENCHMARK(closure)->Unit(benchmark::kMicrosecond);
BENCHMARK(epsilon)->Unit(benchmark::kMicrosecond);
BENCHMARK(deepest_penetration)->Unit(benchmark::kMicrosecond);
BENCHMARK(exactly_legal)->Unit(benchmark::kMicrosecond);
BENCHMARK(palm_approach)->Unit(benchmark::kMicrosecond);
BENCHMARK(whole_candidate)->Unit(benchmark::kMicrosecond);
