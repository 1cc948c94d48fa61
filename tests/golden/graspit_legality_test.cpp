// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Provenance: reference/states.jsonl, what GraspIt! itself calls legal and the contact energies it computed,
// for 300 states of each of 4 hands and 6 objects. GraspIt! tests surfaces only: a link wholly inside the
// object is legal to it, not to us; such states are counted apart.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"
#include "support/graspit_models.hpp"

namespace eigengrasp {
namespace {

struct Tally {
  int states = 0;
  int agreed = 0;
  int contained = 0;
  std::vector<double> exact_residuals;  ///< of the contact energy [mm]
  std::vector<double> field_residuals;

  void add(const Tally& t) {
    states += t.states;
    agreed += t.agreed;
    contained += t.contained;
    exact_residuals.insert(exact_residuals.end(), t.exact_residuals.begin(), t.exact_residuals.end());
    field_residuals.insert(field_residuals.end(), t.field_residuals.begin(), t.field_residuals.end());
  }
  double agreement() const { return static_cast<double>(agreed) / std::max(1, states - contained); }
};

void print(const std::string& name, const Tally& t) {
  std::cout << fmt::format(
      "{:20} {:5} states, {:6.2f} % alike, {} contained; energy off by {:.4f} mm at most, with the field "
      "median {:.2f}, p95 {:.2f}, largest {:.2f} mm\n",
      name, t.states, 100.0 * t.agreement(), t.contained, testing::percentile(t.exact_residuals, 1.0),
      testing::percentile(t.field_residuals, 0.5), testing::percentile(t.field_residuals, 0.95),
      testing::percentile(t.field_residuals, 1.0));
}

bool any_link_contained(const CollisionModel& model, const std::vector<Pose>& X_OL) {
  for (std::size_t i = 0; i < X_OL.size(); ++i)
    if (model.overlap_with_object(static_cast<int>(i), X_OL[i]).contained) return true;
  return false;
}

void rate(const CollisionModel& model, const testing::ReferenceLine& line, Tally& tally) {
  const HandModel& hand = *line.scene.hand;
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joint_values(hand, testing::vector_of(line.json["dofs"])), line.X_OH, X_OL);
  const bool theirs = line.json["legal"];
  const bool ours = model.check_exact(X_OL) == Legality::legal;
  ++tally.states;
  tally.agreed += ours == theirs;
  tally.contained += theirs && !ours && any_link_contained(model, X_OL);
  if (!theirs) return;
  const GraspEnergy energy(model, {});
  const double expected = line.json["contact_energy"];
  std::vector<ContactApproach> approaches;
  energy.approach(X_OL, DistanceSource::exact, approaches);
  tally.exact_residuals.push_back(std::abs(energy.contact_energy(approaches) - expected));
  energy.approach(X_OL, DistanceSource::field, approaches);
  tally.field_residuals.push_back(std::abs(energy.contact_energy(approaches) - expected));
}

TEST(GraspitStates, LegalityAndEnergyVsGraspit) {
  const auto models = testing::graspit_models();
  const auto states = testing::test_data("reference/states.jsonl");
  EIGENGRASP_REQUIRE_DATA(models);
  EIGENGRASP_REQUIRE_DATA(states);
  std::map<std::string, Tally> tallies;
  std::unique_ptr<CollisionModel> model;
  testing::for_each_reference(states, [&](const testing::ReferenceLine& line) {
    if (!tallies.contains(line.pair)) {
      CollisionModel::Options options;
      options.cover_tolerance = 0.0;  // the distance field alone
      model = std::make_unique<CollisionModel>(line.scene, options);
    }
    rate(*model, line, tallies[line.pair]);
  });
  Tally all;
  for (const auto& [pair, tally] : tallies) {
    print(pair, tally);
    all.add(tally);
  }
  print("all", all);
  EXPECT_EQ(tallies.size(), 24u);
  EXPECT_EQ(all.states, 7200);
  EXPECT_GE(all.agreement(), 0.995);
  EXPECT_LT(testing::percentile(all.exact_residuals, 1.0), 0.05);
  EXPECT_LT(testing::percentile(all.field_residuals, 0.95), 0.5);
}

}  // namespace
}  // namespace eigengrasp
