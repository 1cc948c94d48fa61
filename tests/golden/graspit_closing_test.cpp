// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Provenance: reference/grasps.jsonl, where GraspIt!'s own "auto grasp" stopped the fingers, for 25
// pre-grasps of each of 4 hands and 6 objects.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/planning/finger_closing.hpp"
#include "eigengrasp/quality/wrench_space.hpp"
#include "support/graspit_models.hpp"

namespace eigengrasp {
namespace {

struct Tally {
  int closings = 0;
  int alike = 0;  ///< every degree of freedom within 0.03 rad
  int penetrating = 0;
  int without_contact = 0;
  int closed_ours = 0, closed_theirs = 0;  ///< to form closure
  std::vector<double> residuals;           ///< largest of each closing [rad]

  void add(const Tally& t) {
    closings += t.closings;
    alike += t.alike;
    penetrating += t.penetrating;
    without_contact += t.without_contact;
    closed_ours += t.closed_ours;
    closed_theirs += t.closed_theirs;
    residuals.insert(residuals.end(), t.residuals.begin(), t.residuals.end());
  }
};

void print(const std::string& name, const Tally& t) {
  std::cout << fmt::format(
      "{:20} {:4} closings, {:3} within 0.03 rad, median {:.4f}, p95 {:.4f} rad; form closure ours {}, "
      "theirs {}; penetrating {}, without contact {}\n",
      name, t.closings, t.alike, testing::percentile(t.residuals, 0.5),
      testing::percentile(t.residuals, 0.95), t.closed_ours, t.closed_theirs, t.penetrating,
      t.without_contact);
}

bool form_closed(const ObjectModel& object, const std::vector<GraspContact>& contacts) {
  WrenchSpaceOptions options;
  options.torque_origin_O = object.center_of_mass;
  options.torque_scale = object.max_radius;
  std::vector<ContactPoint> points;
  for (const GraspContact& c : contacts) points.push_back(c.point);
  return compute_epsilon(points, options).form_closure;
}

void compare(const CollisionModel& model, const testing::ReferenceLine& line, Tally& tally) {
  const ClosedHand closed = close_fingers(model, line.X_OH, testing::vector_of(line.json["pregrasp_dofs"]));
  const double residual = (closed.dofs - testing::vector_of(line.json["closed_dofs"])).cwiseAbs().maxCoeff();
  const auto contacts = find_contacts(model, closed.X_OL);
  EXPECT_FALSE(closed.started_in_collision) << line.pair;
  ++tally.closings;
  tally.alike += residual <= 0.03;
  tally.residuals.push_back(residual);
  tally.penetrating += model.check_exact(closed.X_OL) != Legality::legal;
  tally.without_contact += contacts.empty();
  tally.closed_ours += form_closed(*line.scene.object, contacts);
  tally.closed_theirs += line.json["epsilon_qhull"].get<double>() > 1e-6;
}

TEST(GraspitClosing, JointValuesVsGraspit) {
  const auto models = testing::graspit_models();
  const auto grasps = testing::test_data("reference/grasps.jsonl");
  EIGENGRASP_REQUIRE_DATA(models);
  EIGENGRASP_REQUIRE_DATA(grasps);
  std::map<std::string, Tally> tallies;
  std::unique_ptr<CollisionModel> model;
  testing::for_each_reference(grasps, [&](const testing::ReferenceLine& line) {
    if (!tallies.contains(line.pair)) {
      CollisionModel::Options options;
      options.fast = false;
      model = std::make_unique<CollisionModel>(line.scene, options);
    }
    compare(*model, line, tallies[line.pair]);
  });
  Tally all;
  for (const auto& [pair, tally] : tallies) {
    print(pair, tally);
    all.add(tally);
  }
  print("all", all);
  EXPECT_EQ(tallies.size(), 24u);
  EXPECT_EQ(all.closings, 600);
  EXPECT_GE(all.alike, 0.9 * all.closings);
  EXPECT_EQ(all.penetrating, 0);
}

}  // namespace
}  // namespace eigengrasp
