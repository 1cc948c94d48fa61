// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Provenance: reference/states.jsonl, contact energies that GraspIt! itself computed for given hand poses and
// degrees of freedom. They depend on kinematics, couplings, contact files and object surfaces alike.
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "support/graspit_reference.hpp"

namespace eigengrasp {
namespace {

/// Mean over the virtual contacts of distance [mm] + 50 (1 - n . direction to the nearest point).
double contact_energy(const HandModel& hand, const ObjectModel& object, const Pose& X_OH,
                      const VecX& posture) {
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joint_values(hand, posture), X_OH, X_OL);
  double sum = 0.0;
  for (const VirtualContact& contact : hand.virtual_contacts) {
    const Pose& X = X_OL[static_cast<std::size_t>(contact.link)];
    const Vec3 p = X * contact.p_LC;
    const ClosestPoint nearest = object.bvh.closest_point(p);
    const Vec3 direction = (nearest.point - p) / nearest.distance;
    sum += 1e3 * nearest.distance + 50.0 * (1.0 - direction.dot(X.linear() * contact.n_LC));
  }
  return sum / static_cast<double>(hand.virtual_contacts.size());
}

struct Residual {
  int states = 0;
  int exact = 0;  ///< within what the reference file's digits allow, unless a contact touches the surface
  double largest = 0.0;
};

TEST(GraspitStates, ContactEnergyVsGraspit) {
  const auto models = testing::graspit_models();
  const auto states = testing::test_data("reference/states.jsonl");
  EIGENGRASP_REQUIRE_DATA(models);
  EIGENGRASP_REQUIRE_DATA(states);
  std::map<std::string, HandModel> hands;
  std::map<std::string, ObjectModel> objects;
  std::map<std::string, Residual> residuals;
  std::ifstream in(states);
  for (std::string line; std::getline(in, line);) {
    const auto state = nlohmann::json::parse(line);
    if (!state["legal"].get<bool>()) continue;
    const std::string hand_name = state["hand"], object_name = state["object"];
    if (!hands.contains(hand_name)) {
      hands[hand_name] = testing::load_reference_hand(hand_name, {.load_meshes = false});
    }
    if (!objects.contains(object_name)) {
      objects[object_name] = load_graspit_body(models / "objects" / (object_name + ".xml"));
    }
    const auto pose = state["hand_pose"].get<std::vector<double>>();
    const auto dofs = state["dofs"].get<std::vector<double>>();
    const Pose X_OH = make_pose(Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]),
                                1e-3 * Vec3(pose[0], pose[1], pose[2]));
    const VecX posture = Eigen::Map<const VecX>(dofs.data(), static_cast<Eigen::Index>(dofs.size()));
    const double energy = contact_energy(hands[hand_name], objects[object_name], X_OH, posture);
    Residual& residual = residuals[hand_name];
    ++residual.states;
    const double difference = std::abs(energy - state["contact_energy"].get<double>());
    residual.exact += difference < 1e-4;
    residual.largest = std::max(residual.largest, difference);
  }
  EXPECT_EQ(residuals.size(), 4u);
  for (const auto& [name, residual] : residuals) {
    RecordProperty(name + "_largest_residual_mm", std::to_string(residual.largest));
    std::cout << name << ": " << residual.states << " states, largest residual " << residual.largest
              << " mm\n";
    EXPECT_GT(residual.states, 100) << name;
    EXPECT_LT(residual.largest, 0.05) << name;
    EXPECT_GT(residual.exact, 0.95 * residual.states) << name;
  }
  EXPECT_EQ(hands["Barrett"].virtual_contacts.size(), 19u);
  EXPECT_EQ(hands["DLR"].virtual_contacts.size(), 13u);
  EXPECT_EQ(hands["Robonaut13"].virtual_contacts.size(), 15u);
  EXPECT_EQ(hands["Human"].virtual_contacts.size(), 18u);
}

}  // namespace
}  // namespace eigengrasp
