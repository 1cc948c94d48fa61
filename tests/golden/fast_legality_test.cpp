// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The evaluator's legality against the exact meshes, for GraspIt!'s 4 hands and 6 objects: the reference
// states of reference/states.jsonl (their poses and postures; what GraspIt! calls legal is not asked here),
// and states that annealing visits. None that is called legal may intrude deeper than 1 mm, and at most 2 %
// of those that touch nothing may be refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "support/graspit_models.hpp"
#include "support/state_walk.hpp"

namespace eigengrasp {
namespace {

constexpr double too_deep = 0.001;  // [m]
using Verdict = StateEvaluator::Verdict;

struct Tally {
  int states = 0;
  int legal = 0;  ///< by the meshes
  int refused_by_object = 0;
  int refused_by_hand = 0;
  int intruding = 0;  ///< called legal, but not by the meshes
  int too_deep = 0;
  double deepest = 0.0;  ///< of those called legal [m]

  void add(const Tally& t) {
    states += t.states;
    legal += t.legal;
    refused_by_object += t.refused_by_object;
    refused_by_hand += t.refused_by_hand;
    intruding += t.intruding;
    too_deep += t.too_deep;
    deepest = std::max(deepest, t.deepest);
  }
  double refused() const {
    return static_cast<double>(refused_by_object + refused_by_hand) / std::max(1, legal);
  }
};

void print(const std::string& name, const Tally& t) {
  std::cout << fmt::format(
      "{:32} {:6} states, {:6} legal, {:5.2f} % refused ({} by the object, {} by the hand); called legal, "
      "but "
      "intrude: {}, {} deeper than 1 mm, deepest {:.2f} mm\n",
      name, t.states, t.legal, 100.0 * t.refused(), t.refused_by_object, t.refused_by_hand, t.intruding,
      t.too_deep, 1000.0 * t.deepest);
}

void judge(const CollisionModel& model, const SearchSpace& space, const HandState& state, Verdict verdict,
           Tally& tally) {
  const auto X_OL = testing::link_poses(*model.scene().hand, space, state);
  const bool legal = model.check_exact(X_OL) == Legality::legal;
  ++tally.states;
  tally.legal += legal;
  tally.refused_by_object += legal && verdict == Verdict::hits_object;
  tally.refused_by_hand += legal && verdict == Verdict::hits_itself;
  if (legal || verdict != Verdict::legal) return;
  const double depth = model.deepest_penetration(X_OL);
  ++tally.intruding;
  tally.too_deep += depth > too_deep;
  tally.deepest = std::max(tally.deepest, depth);
}

/// One hand and object, and its reference states.
struct Pair {
  std::string name;
  Scene scene;
  std::vector<Pose> X_OH;
  std::vector<VecX> dofs;
  Tally reference, visited;
};

std::vector<Pair> read_pairs(const std::filesystem::path& states) {
  std::vector<Pair> pairs;
  testing::for_each_reference(states, [&](const testing::ReferenceLine& line) {
    if (pairs.empty() || pairs.back().name != line.pair)
      pairs.push_back({line.pair, line.scene, {}, {}, {}, {}});
    pairs.back().X_OH.push_back(line.X_OH);
    pairs.back().dofs.push_back(testing::vector_of(line.json["dofs"]));
  });
  return pairs;
}

/// Reference postures lie outside of the space of eigengrasps: all degrees of freedom are amplitudes.
void judge_reference(const CollisionModel& model, Pair& pair) {
  const HandModel& hand = *pair.scene.hand;
  SearchSpace space(pair.scene, 0);
  space.postures =
      EigengraspSpace::identity(VecX::Zero(hand.n_dof()), hand.dof_min(), hand.dof_max(), hand.dof_names());
  const StateEvaluator evaluator(model, space.postures, 0.05);
  StateEvaluator::Batch batch(evaluator);
  constexpr std::size_t n = StateEvaluator::lanes;
  for (std::size_t first = 0; first < pair.X_OH.size(); first += n) {
    const std::size_t count = std::min(n, pair.X_OH.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      const Pose& X_OH = pair.X_OH[first + k];
      batch.set(static_cast<int>(k),
                {X_OH * hand.approach_point_H, Eigen::Quaterniond(X_OH.linear()), pair.dofs[first + k]});
    }
    evaluator.evaluate(batch);
    for (int k = 0; k < static_cast<int>(count); ++k)
      judge(model, space, batch.state(k), batch.verdict(k), pair.reference);
  }
}

/// Sixteen short chains, ten times, as the search in stages; one state of ten is checked.
void judge_visited(const CollisionModel& model, std::uint64_t seed, Pair& pair) {
  const SearchSpace space(pair.scene, 2);
  const StateEvaluator evaluator(model, space.postures, 0.05);
  RandomStream choice{seed, 5};
  testing::SeenWalk walk(space, evaluator, seed);
  for (int run = 0; run < 10; ++run)
    walk.anneal({}, 265, [&](const StateEvaluator::Batch& batch) {
      for (int lane = 0; lane < StateEvaluator::lanes; ++lane)
        if (choice.uniform() < 0.1) judge(model, space, batch.state(lane), batch.verdict(lane), pair.visited);
    });
}

std::filesystem::path cache_folder() {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "eigengrasp_fast_legality";
  std::filesystem::remove_all(folder);
  return folder;
}

TEST(FastLegality, OfGraspitHandsVsExactMeshes) {
  const auto models = testing::graspit_models();
  const auto states = testing::test_data("reference/states.jsonl");
  EIGENGRASP_REQUIRE_DATA(models);
  EIGENGRASP_REQUIRE_DATA(states);
  auto pairs = read_pairs(states);
  ASSERT_EQ(pairs.size(), 24u);
  CollisionModel::Options options;
  options.threads = 1;
  // Hands and objects are prepared once.
  options.cache = std::make_shared<PreparationCache>(PreparationCacheOptions{cache_folder()});
  parallel_for(pairs.size(), 2, [&](std::size_t i, int) {
    const CollisionModel model(pairs[i].scene, options);
    judge_reference(model, pairs[i]);
    judge_visited(model, i + 1, pairs[i]);
  });
  Tally reference, visited;
  for (const Pair& pair : pairs) {
    print(pair.name + ", reference", pair.reference);
    print(pair.name + ", visited", pair.visited);
    reference.add(pair.reference);
    visited.add(pair.visited);
    for (const Tally* t : {&pair.reference, &pair.visited}) {
      EXPECT_EQ(t->too_deep, 0) << pair.name;
      EXPECT_LE(t->refused(), 0.02) << pair.name;
    }
  }
  print("all, reference", reference);
  print("all, visited", visited);
  EXPECT_EQ(reference.states, 7200);
  EXPECT_GE(visited.states, 100000);
}

}  // namespace
}  // namespace eigengrasp
