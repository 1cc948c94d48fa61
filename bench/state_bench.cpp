// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// States of the search: sixteen at once with every instruction set that the machine has, one at a time, and
// steps of annealing. "random": anywhere in the search space, as a search begins. "near": some millimetres
// and hundredths of a radian about the best states of a short search, as one ends. items_per_second counts
// states; legal (share) and energy (mean of the legal ones) tell whether the results are still the same.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "eigengrasp/planning/annealer.hpp"

namespace {

using namespace eigengrasp;

constexpr std::size_t n_states = 1024;
constexpr int steps_of_a_search = 1000;

Scene shipped_scene(const char* hand, const char* object) {
  Scene scene;
  scene.hand = std::make_shared<const HandModel>(load_hand(find_hand(hand)));
  scene.object = std::make_shared<const ObjectModel>(load_object(find_object(object)));
  scene.object_material.name = scene.object->material;
  return scene;
}

/// A hand and an object, ready to be searched.
struct Bench {
  Scene scene;
  PlanOptions options;
  CollisionModel model;
  GraspEnergy energy;
  SearchSpace space;

  explicit Bench(const Scene& s)
      : scene(s), model(s, CollisionModel::Options{}), energy(model, options), space(s, options.amplitudes) {}

  StateEvaluator evaluator(InstructionSet set) const {
    return StateEvaluator(model, space.postures, options.alpha, set);
  }
  Annealer annealer(const StateEvaluator& evaluator, int n_chains) const {
    Distinctness distinct;
    distinct.approach_point_H = scene.hand->approach_point_H;
    return Annealer({model, energy, space, evaluator, AnnealingSchedule{}, 1}, 0, n_chains,
                    PreGraspList(40, distinct));
  }
};

double progress_of_step(int step) {
  return static_cast<double>(step % steps_of_a_search) / steps_of_a_search;
}

using MakeStates = std::function<std::vector<HandState>(const Bench&)>;

HandState shaken(HandState state, const SearchSpace& space, RandomStream& random, double shift, double turn,
                 double share_of_range) {
  const auto component = [&](double size) { return random.uniform(-size, size); };
  for (Eigen::Index i = 0; i < 3; ++i) state.p_OA[i] += component(shift);
  const Eigen::Quaterniond q(1.0, component(turn), component(turn), component(turn));
  state.q_OA = (state.q_OA * q).normalized();
  for (int i = 0; i < space.postures.size(); ++i) {
    const Eigengrasp& e = space.postures[i];
    const double a = state.amplitudes[i] + component(share_of_range * (e.max - e.min));
    state.amplitudes[i] = std::clamp(a, e.min, e.max);
  }
  return state;
}

std::vector<HandState> random_states(const Bench& bench) {
  RandomStream random{1};
  std::vector<HandState> states;
  for (std::size_t i = 0; i < n_states; ++i) {
    HandState s;
    for (Eigen::Index k = 0; k < 3; ++k)
      s.p_OA[k] = bench.space.center_O[k] + bench.space.half_range[k] * random.uniform(-1.0, 1.0);
    s.q_OA.coeffs() =
        Eigen::Vector4d(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    s.amplitudes = VecX::Zero(bench.space.postures.size());
    states.push_back(shaken(s, bench.space, random, 0.0, 0.0, 0.25));
  }
  return states;
}

std::vector<HandState> near_states(const Bench& bench) {
  const StateEvaluator evaluator = bench.evaluator(best_instruction_set());
  Annealer annealer = bench.annealer(evaluator, 16);
  for (int i = 0; i < steps_of_a_search; ++i) annealer.step(progress_of_step(i), 16);
  const auto& best = annealer.best().items();
  RandomStream random{1};
  std::vector<HandState> states;
  for (std::size_t i = 0; i < n_states; ++i) {
    const PreGrasp& p = best[i % best.size()];
    HandState s;
    s.p_OA = p.X_OH * bench.scene.hand->approach_point_H;
    s.q_OA = p.X_OH.linear();
    s.amplitudes = p.amplitudes;
    states.push_back(shaken(s, bench.space, random, 0.002, 0.01, 0.01));
  }
  return states;
}

/// Of what was found out about the states one after the other.
class Findings {
 public:
  void add(bool legal, double energy) {
    n_legal_ += legal;
    if (legal) sum_ += energy;
  }
  void report(benchmark::State& state, std::size_t n) const {
    state.counters["legal"] = n_legal_ / static_cast<double>(n);
    state.counters["energy"] = n_legal_ > 0 ? sum_ / n_legal_ : 0.0;
  }

 private:
  int n_legal_ = 0;
  double sum_ = 0.0;
};

void evaluate(benchmark::State& state, const Bench& bench, const MakeStates& make, InstructionSet set) {
  const StateEvaluator evaluator = bench.evaluator(set);
  const std::vector<HandState> states = make(bench);
  std::vector<StateEvaluator::Batch> batches;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::size_t lane = i % StateEvaluator::lanes;
    if (lane == 0) batches.emplace_back(evaluator);
    batches.back().set(static_cast<int>(lane), states[i]);
  }
  std::size_t i = 0;
  for (auto _ : state) evaluator.evaluate(batches[i++ % batches.size()]);
  state.SetItemsProcessed(state.iterations() * StateEvaluator::lanes);
  Findings findings;
  for (auto& batch : batches) {
    evaluator.evaluate(batch);
    for (int lane = 0; lane < StateEvaluator::lanes; ++lane)
      findings.add(batch.verdict(lane) == StateEvaluator::Verdict::legal, batch.energy(lane));
  }
  findings.report(state, states.size());
}

/// With the energy of the legal ones alone.
void one_at_a_time(benchmark::State& state, const Bench& bench, const MakeStates& make) {
  const HandModel& hand = *bench.scene.hand;
  const std::vector<HandState> states = make(bench);
  std::vector<Pose> X_OL;
  std::vector<ContactApproach> approaches;
  Findings findings;
  const auto judge = [&](const HandState& s) {
    compute_link_poses(hand, joint_values(hand, hand_posture(hand, bench.space, s)), hand_pose(hand, s),
                       X_OL);
    return bench.model.check_fast(X_OL) == Legality::legal;
  };
  const auto rate = [&] { return bench.energy.evaluate(X_OL, DistanceSource::field, approaches); };
  std::size_t i = 0;
  for (auto _ : state)
    if (judge(states[i++ % states.size()])) benchmark::DoNotOptimize(rate());
  state.SetItemsProcessed(state.iterations());
  for (const HandState& s : states) {
    const bool legal = judge(s);
    findings.add(legal, legal ? rate() : 0.0);
  }
  findings.report(state, states.size());
}

void forward_kinematics(benchmark::State& state, const Bench& bench) {
  const HandModel& hand = *bench.scene.hand;
  const std::vector<HandState> states = random_states(bench);
  std::vector<Pose> X_OL;
  std::size_t i = 0;
  for (auto _ : state) {
    const HandState& s = states[i++ % states.size()];
    compute_link_poses(hand, joint_values(hand, hand_posture(hand, bench.space, s)), hand_pose(hand, s),
                       X_OL);
    benchmark::DoNotOptimize(X_OL.data());
  }
  state.SetItemsProcessed(state.iterations());
}

/// Steps of a search that cools down over a thousand of them and starts again. A lone chain counts the states
/// up to the one that it accepts.
void anneal(benchmark::State& state, const Bench& bench, int n_chains) {
  const StateEvaluator evaluator = bench.evaluator(best_instruction_set());
  const auto step = [](Annealer& annealer, int i) {
    if (i % steps_of_a_search == 0) annealer.restart();
    annealer.step(progress_of_step(i), StateEvaluator::lanes);
  };
  Annealer annealer = bench.annealer(evaluator, n_chains);
  int i = 0;
  for (auto _ : state) step(annealer, i++);
  state.SetItemsProcessed(annealer.iterations());
  Annealer once = bench.annealer(evaluator, n_chains);
  for (int k = 0; k < steps_of_a_search; ++k) step(once, k);
  const auto share = [&](std::int64_t n) {
    return static_cast<double>(n) / static_cast<double>(once.iterations());
  };
  state.counters["legal"] = share(once.counts().legal);
  state.counters["best"] = once.best().items().empty() ? 0.0 : once.best().items().front().energy;
  state.counters["states"] = static_cast<double>(once.iterations()) / steps_of_a_search;
}

struct BenchName {
  const char* hand;
  const char* object;
  std::string text() const { return std::string(hand) + "-" + object; }
};
constexpr std::array scenes{BenchName{"human", "glass"}, BenchName{"barrett-metal", "shoe"},
                            BenchName{"robonaut", "ashtray"}};

/// Only what is run is prepared.
const Bench& bench_of(std::size_t scene) {
  static std::array<std::unique_ptr<Bench>, scenes.size()> made;
  if (!made[scene])
    made[scene] = std::make_unique<Bench>(shipped_scene(scenes[scene].hand, scenes[scene].object));
  return *made[scene];
}

void add(const std::string& name, std::function<void(benchmark::State&)> run) {
  benchmark::RegisterBenchmark(name.c_str(), std::move(run))->Unit(benchmark::kMicrosecond);
}

bool add_all() {
  const std::array<std::pair<const char*, MakeStates>, 2> kinds{
      {{"random", random_states}, {"near", near_states}}};
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const std::string scene = scenes[s].text();
    for (const auto& [kind, make] : kinds) {
      const std::string tail = "/" + scene + "/" + kind;
      for (const InstructionSet set : available_instruction_sets())
        add("evaluate" + tail + "/" + name_of(set),
            [s, make = make, set](benchmark::State& state) { evaluate(state, bench_of(s), make, set); });
      add("one_at_a_time" + tail,
          [s, make = make](benchmark::State& state) { one_at_a_time(state, bench_of(s), make); });
    }
    add("forward_kinematics/" + scene,
        [s](benchmark::State& state) { forward_kinematics(state, bench_of(s)); });
    for (const int n_chains : {1, 16})
      add("anneal/" + scene + "/chains:" + std::to_string(n_chains),
          [s, n_chains](benchmark::State& state) { anneal(state, bench_of(s), n_chains); });
  }
  return true;
}

const bool added = add_all();

}  // namespace
