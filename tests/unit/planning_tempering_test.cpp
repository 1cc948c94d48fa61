// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "eigengrasp/planning/temperature_ladder.hpp"

namespace eigengrasp {
namespace {

// Two valleys with a ridge between them that a cold chain hardly ever crosses.
constexpr std::array landscape{0.0, 2.0, 6.0, 8.0, 5.0, 1.0, 0.5};
const std::vector<double> temperatures{0.5, 0.9, 1.6, 3.0};

double boltzmann(std::size_t place, double temperature) {
  double sum = 0.0;
  for (const double e : landscape) sum += std::exp(-e / temperature);
  return std::exp(-landscape[place] / temperature) / sum;
}

/// A Metropolis walk of each chain to its neighbours on the landscape, all beginning at the left end.
class Walk {
 public:
  explicit Walk(std::uint64_t seed, bool exchanges)
      : exchanges_(exchanges), ladder_(temperatures, RandomStream{seed, 1}), random_{seed, 2} {}

  void step() {
    for (std::size_t c = 0; c < place_.size(); ++c) {
      const std::size_t to = random_.uniform() < 0.5 ? place_[c] - 1 : place_[c] + 1;
      const double u = random_.uniform();
      if (to >= landscape.size()) continue;  // beyond an end: stays
      const double rise = landscape[to] - landscape[place_[c]];
      if (u < std::exp(-rise / ladder_.temperature(static_cast<int>(c)))) place_[c] = to;
    }
    if (!exchanges_) return;
    std::array<float, 4> energies;
    for (std::size_t c = 0; c < place_.size(); ++c) energies[c] = static_cast<float>(landscape[place_[c]]);
    ladder_.exchange(energies.data());
  }
  /// On each rung.
  std::array<std::size_t, 4> places() const {
    std::array<std::size_t, 4> on_rung{};
    for (std::size_t c = 0; c < place_.size(); ++c)
      on_rung[static_cast<std::size_t>(ladder_.rung(static_cast<int>(c)))] = place_[c];
    return on_rung;
  }
  const TemperatureLadder& ladder() const { return ladder_; }

 private:
  bool exchanges_;
  TemperatureLadder ladder_;
  RandomStream random_;
  std::array<std::size_t, 4> place_{};
};

TEST(TemperatureLadder, KeepsTheBoltzmannDistributionOfEveryTemperature) {
  Walk walk(7, true);
  constexpr int steps = 400000;
  std::array<std::array<double, landscape.size()>, 4> share{};
  for (int i = 0; i < steps; ++i) {
    walk.step();
    const auto places = walk.places();
    for (std::size_t rung = 0; rung < places.size(); ++rung) share[rung][places[rung]] += 1.0 / steps;
  }
  for (std::size_t rung = 0; rung < share.size(); ++rung)
    for (std::size_t place = 0; place < landscape.size(); ++place)
      EXPECT_NEAR(share[rung][place], boltzmann(place, temperatures[rung]), 0.02)
          << "rung " << rung << ", place " << place;
}

TEST(TemperatureLadder, BringsTheColdChainOverARidge) {
  const auto steps_to_the_other_side = [](bool exchanges) {
    Walk walk(3, exchanges);
    int steps = 0;
    while (walk.places()[0] < 5 && steps < 100000) walk.step(), ++steps;
    return steps;
  };
  EXPECT_LT(steps_to_the_other_side(true), 5000);
  EXPECT_GT(steps_to_the_other_side(false), 50000);
}

TEST(TemperatureLadder, EveryTemperatureHasOneChain) {
  Walk walk(1, true);
  std::set<int> seen_by_first;
  for (int i = 0; i < 2000; ++i) {
    walk.step();
    std::set<int> rungs;
    for (int c = 0; c < walk.ladder().size(); ++c) {
      rungs.insert(walk.ladder().rung(c));
      EXPECT_EQ(walk.ladder().temperature(c), temperatures[static_cast<std::size_t>(walk.ladder().rung(c))]);
    }
    EXPECT_EQ(rungs.size(), temperatures.size());
    seen_by_first.insert(walk.ladder().rung(0));
  }
  EXPECT_EQ(seen_by_first.size(), temperatures.size()) << "a chain wanders through all temperatures";
}

TEST(TemperatureLadder, AlwaysTradesWhereTheColderChainIsHigherAndGoesBackWhenReset) {
  TemperatureLadder ladder({1.0, 2.0}, RandomStream{1});
  const std::array energies{5.0f, 1.0f};
  ladder.exchange(energies.data());
  EXPECT_EQ(ladder.rung(0), 1);
  EXPECT_EQ(ladder.rung(1), 0);
  ladder.exchange(energies.data());  // the turn of pair (1, 2), which is not there
  EXPECT_EQ(ladder.rung(0), 1);
  ladder.reset();
  EXPECT_EQ(ladder.rung(0), 0);
  EXPECT_EQ(ladder.rung(1), 1);
}

}  // namespace
}  // namespace eigengrasp
