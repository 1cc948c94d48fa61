// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Walks of the annealer: repeatable, the same with all instruction sets, alike in distribution whether one
// chain or sixteen walk, and with states that scalar code confirms.
#include "eigengrasp/planning/annealer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/parallel_gripper.hpp"
#include "support/state_walk.hpp"

namespace eigengrasp {
namespace {

constexpr double alpha = 0.05;
constexpr std::int64_t endless = 1000000000;

Scene block_scene() {
  auto hand = testing::two_finger_hand();
  set_collision_pairs(*hand, {});
  return testing::scene_of(hand, testing::solid(testing::box_mesh({0.03, 0.035, 0.04})));
}

struct Walks {
  explicit Walks(const Scene& scene = block_scene(), InstructionSet set = best_instruction_set())
      : model(scene, CollisionModel::Options{.threads = 1, .cache = {}}),
        energy(model, {}),
        space(scene, 2),
        evaluator(model, space.postures, alpha, set) {}

  Annealer annealer(std::uint64_t number, int n_chains, std::size_t capacity = 20, std::uint64_t seed = 5,
                    bool tempered = false) const {
    Distinctness distinct;
    distinct.approach_point_H = model.scene().hand->approach_point_H;
    return Annealer({model, energy, space, evaluator, {}, seed, false, tempered}, number, n_chains,
                    {capacity, distinct});
  }

  CollisionModel model;
  GraspEnergy energy;
  SearchSpace space;
  StateEvaluator evaluator;
};

void anneal(Annealer& annealer, int steps, std::int64_t most = endless) {
  for (int i = 0; i < steps; ++i) annealer.step(static_cast<double>(i) / steps, most - annealer.iterations());
}

void expect_same(Annealer& a, Annealer& b) {
  EXPECT_EQ(a.iterations(), b.iterations());
  EXPECT_EQ(a.counts().legal, b.counts().legal);
  EXPECT_EQ(a.counts().hit_object, b.counts().hit_object);
  EXPECT_EQ(a.counts().hit_itself, b.counts().hit_itself);
  ASSERT_EQ(a.milestones().size(), b.milestones().size());
  for (std::size_t i = 0; i < a.milestones().size(); ++i) {
    EXPECT_EQ(a.milestones()[i].iteration, b.milestones()[i].iteration);
    EXPECT_EQ(a.milestones()[i].energy, b.milestones()[i].energy);
    EXPECT_EQ(a.milestones()[i].X_OH.matrix(), b.milestones()[i].X_OH.matrix());
  }
  ASSERT_EQ(a.best().items().size(), b.best().items().size());
  for (std::size_t i = 0; i < a.best().items().size(); ++i) {
    EXPECT_EQ(a.best().items()[i].energy, b.best().items()[i].energy);
    EXPECT_EQ(a.best().items()[i].dofs, b.best().items()[i].dofs);
    EXPECT_EQ(a.best().items()[i].X_OH.matrix(), b.best().items()[i].X_OH.matrix());
  }
}

TEST(Annealer, WalksAlikeWithEveryInstructionSet) {
  const Scene scene = block_scene();
  const Walks baseline(scene, InstructionSet::baseline);
  for (const int n_chains : {1, 16}) {
    Annealer expected = baseline.annealer(3, n_chains);
    anneal(expected, 600);
    ASSERT_FALSE(expected.best().items().empty());
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(name_of(set));
      const Walks walks(scene, set);
      Annealer annealer = walks.annealer(3, n_chains);
      anneal(annealer, 600);
      expect_same(annealer, expected);
    }
  }
}

TEST(Annealer, RepeatsItselfForASeedAndNumberOnly) {
  const Walks walks;
  Annealer a = walks.annealer(1, 16);
  Annealer b = walks.annealer(1, 16);
  Annealer other_number = walks.annealer(2, 16);
  Annealer other_seed = walks.annealer(1, 16, 20, 6);
  for (Annealer* x : {&a, &b, &other_number, &other_seed}) anneal(*x, 300);
  expect_same(a, b);
  EXPECT_NE(a.best().items().front().energy, other_number.best().items().front().energy);
  EXPECT_NE(a.best().items().front().energy, other_seed.best().items().front().energy);
}

TEST(Annealer, TemperedWalksAlikeWithEveryInstructionSetAndNotAsACoolingOne) {
  const Scene scene = block_scene();
  const Walks baseline(scene, InstructionSet::baseline);
  const Walks best(scene);
  Annealer expected = baseline.annealer(3, 16, 20, 5, true);
  Annealer same = best.annealer(3, 16, 20, 5, true);
  Annealer cooling = best.annealer(3, 16);
  for (Annealer* x : {&expected, &same, &cooling}) anneal(*x, 600);
  expect_same(same, expected);
  EXPECT_NE(cooling.best().items().front().energy, expected.best().items().front().energy);
}

TEST(Annealer, CountsAddUpAndKeepToTheMost) {
  Scene scene = block_scene();
  scene.obstacles.push_back(make_table(-0.02));
  const Walks walks(scene);
  for (const int n_chains : {1, 16})
    for (const std::int64_t most : {1, 15, 16, 17, 1000, 2345}) {
      Annealer annealer = walks.annealer(0, n_chains);
      while (annealer.iterations() < most) {
        const std::int64_t before = annealer.iterations();
        annealer.step(0.5, most - before);
        EXPECT_GT(annealer.iterations(), before);
        EXPECT_LE(annealer.iterations() - before, 16);
      }
      const StateCounts& c = annealer.counts();
      EXPECT_EQ(c.evaluated, most);
      EXPECT_EQ(c.legal + c.hit_object + c.hit_itself + c.hit_obstacle, c.evaluated);
      if (most > 2000) {
        EXPECT_GT(c.hit_obstacle, 0);
      }
    }
}

TEST(Annealer, ItsBestAreLegalAndHaveTheEnergyOfScalarCode) {
  const Walks walks;
  const HandModel& hand = *walks.model.scene().hand;
  for (const int n_chains : {1, 16}) {
    Annealer annealer = walks.annealer(4, n_chains);
    anneal(annealer, 1500);
    ASSERT_GT(annealer.best().items().size(), 5u);
    std::vector<double> residuals;
    std::vector<ContactApproach> approaches;
    std::vector<Pose> X_OL;
    for (const PreGrasp& p : annealer.best().items()) {
      EXPECT_EQ(p.dofs, clamp_posture(hand, walks.space.postures.embed(p.amplitudes)));
      EXPECT_EQ(p.chain, 4 * 16 + p.chain % 16);
      EXPECT_LE(p.iteration, annealer.iterations());
      compute_link_poses(hand, joint_values(hand, p.dofs), p.X_OH, X_OL);
      EXPECT_LT(walks.model.deepest_penetration(X_OL), 0.001);
      walks.energy.approach(X_OL, DistanceSource::exact, approaches);
      residuals.push_back(std::abs(walks.energy.contact_energy(approaches) - p.energy));
    }
    std::sort(residuals.begin(), residuals.end());
    EXPECT_LT(residuals[residuals.size() / 2], 1.0) << "error of the field [mm]";
    EXPECT_EQ(annealer.milestones().back().energy, annealer.best().items().front().energy);
    for (std::size_t i = 1; i < annealer.milestones().size(); ++i)
      EXPECT_LT(annealer.milestones()[i].energy, annealer.milestones()[i - 1].energy);
    annealer.forget();
    EXPECT_TRUE(annealer.best().items().empty());
  }
}

TEST(Annealer, AStartThatIsGivenIsWhereAChainGoesOnFrom) {
  const Walks walks;
  Annealer found = walks.annealer(4, 16);
  anneal(found, 500);
  const PreGrasp& best = found.best().items().front();
  HandState start{best.X_OH * walks.model.scene().hand->approach_point_H,
                  Eigen::Quaterniond(best.X_OH.linear()), best.amplitudes};
  Annealer annealer = walks.annealer(9, 1);
  annealer.restart(0, start);
  for (int i = 0; i < 50 && annealer.best().items().empty(); ++i) annealer.step(1.0, endless);
  ASSERT_FALSE(annealer.milestones().empty());
  EXPECT_LT((annealer.milestones().front().X_OH.translation() - best.X_OH.translation()).norm(), 0.3);
}

/// Share of states that are counted legal (some of too high an energy are not asked), and mean of the best
/// energies, over many walks of the same length.
struct Statistics {
  double legal_share;
  double best_energy;
};

template <typename Run>
Statistics over_walks(int n, const Run& run) {
  double legal = 0.0, energy = 0.0;
  for (int i = 0; i < n; ++i) {
    const Statistics s = run(i);
    legal += s.legal_share / n;
    energy += s.best_energy / n;
  }
  return {legal, energy};
}

// Throwing away the draws behind an accepted one leaves the walk that draws one after the other: the same
// number of states a chain, the same shares and energies as sixteen chains and as scalar code.
TEST(Annealer, ALoneChainWalksAsOneOfSixteenAndAsScalarCode) {
  const Walks walks;
  constexpr int each = 1500;  // states a chain
  const auto measure = [](const Annealer& a) {
    return Statistics{static_cast<double>(a.counts().legal) / static_cast<double>(a.counts().evaluated),
                      a.milestones().empty() ? 200.0 : a.milestones().back().energy};
  };
  const Statistics lone = over_walks(320, [&](int i) {
    Annealer annealer = walks.annealer(static_cast<std::uint64_t>(i), 1, 1);
    while (annealer.iterations() < each)
      annealer.step(static_cast<double>(annealer.iterations()) / each, each - annealer.iterations());
    return measure(annealer);
  });
  // The best of a lone chain is that of one walk: so the scalar walk's chains are told apart.
  double best = 0.0;
  constexpr int squads = 20;
  for (int i = 0; i < squads; ++i) {
    std::vector<double> lowest(16, 1e8);
    testing::SeenWalk walk(walks.space, walks.evaluator, static_cast<std::uint64_t>(i));
    walk.anneal({}, each, [&](const StateEvaluator::Batch& batch) {
      for (int c = 0; c < 16; ++c) {
        if (batch.verdict(c) != StateEvaluator::Verdict::legal) continue;
        lowest[static_cast<std::size_t>(c)] = std::min(lowest[static_cast<std::size_t>(c)], batch.energy(c));
      }
    });
    for (const double e : lowest) best += std::min(e, 200.0) / (16.0 * squads);
  }
  const Statistics together = over_walks(20, [&](int i) {
    Annealer annealer = walks.annealer(1000 + static_cast<std::uint64_t>(i), 16, 1);
    anneal(annealer, each);
    return measure(annealer);
  });
  std::cout << "lone: legal " << lone.legal_share << ", best " << lone.best_energy << "; sixteen: legal "
            << together.legal_share << ", best of all " << together.best_energy << "; scalar: best " << best
            << "\n";
  EXPECT_NEAR(lone.legal_share, together.legal_share, 0.01);
  EXPECT_NEAR(lone.best_energy, best, 0.1 * best);
  EXPECT_LE(together.best_energy, lone.best_energy);
}

}  // namespace
}  // namespace eigengrasp
