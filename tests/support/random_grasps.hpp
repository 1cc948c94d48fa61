// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <fmt/format.h>

#include <bit>
#include <random>

#include "eigengrasp/database/store_records.hpp"

namespace eigengrasp::testing {

/// Hands and grasps for stores: seeded, of any size, with all members set.
inline StoredHand stored_hand(const std::string& name, int n_joints = 20) {
  StoredHand hand{name, {}, {}, {"palm"}};
  for (int i = 0; i < n_joints; ++i) {
    hand.joints.push_back(fmt::format("finger{}_joint{}", i / 4, i % 4));
    hand.links.push_back(fmt::format("finger{}_link{}", i / 4, i % 4));
    if (i % 4 != 3) hand.dofs.push_back(fmt::format("d{}", hand.dofs.size()));
  }
  return hand;
}

class RandomGrasps {
 public:
  explicit RandomGrasps(std::uint64_t seed) : random_(seed) {}

  double number() { return std::normal_distribution<double>(0.0, 0.1)(random_); }
  Vec3 vector() { return {number(), number(), number()}; }
  VecX numbers(std::size_t n) {
    VecX v(static_cast<Eigen::Index>(n));
    for (double& x : v) x = number();
    return v;
  }
  Pose pose() {
    return make_pose(Eigen::Quaterniond(number(), number(), number(), 0.1 + std::abs(number())), vector());
  }

  Grasp grasp(const UnitKey& key, const StoredHand& hand, int n_contacts = 10) {
    Grasp g;
    g.object = key.object;
    g.object_scale = key.scale;
    g.hand = key.hand;
    g.X_OH_pregrasp = pose();
    g.X_OH = pose();
    for (const std::string& joint : hand.joints) {
      g.pregrasp_joints.emplace_back(joint, number());
      g.grasp_joints.emplace_back(joint, number());
    }
    g.pregrasp_dofs = numbers(hand.dofs.size());
    g.grasp_dofs = numbers(hand.dofs.size());
    g.amplitudes = numbers(2);
    for (int i = 0; i < n_contacts; ++i) {
      const std::string& link = hand.links[random_() % hand.links.size()];
      g.contacts.push_back({link, i / 3, {vector(), vector().normalized(), 0.5, i % 2 ? 0.004 : 0.0}});
    }
    g.energy = number();
    g.epsilon = std::abs(number());
    g.volume = number() * number();
    g.form_closure = random_() % 2 == 0;
    g.max_penetration = 1e-4 * number();
    g.provenance = {"annealing/contact", random_(), "fnv1a64:0123456789abcdef", "0.1.0"};
    return g;
  }

  std::vector<StoredGrasp> grasps(const UnitKey& key, const StoredHand& hand, std::size_t n,
                                  const std::string& source = "planner") {
    std::vector<StoredGrasp> made;
    for (std::size_t i = 0; i < n; ++i) made.push_back({0, source, grasp(key, hand)});
    return made;
  }

 private:
  std::mt19937_64 random_;
};

/// All that a grasp holds, as bits: equal for grasps that are the same to the last of them.
inline std::string bits_of(const Grasp& g) {
  std::string out = fmt::format("{}|{}|{}|{}", g.hand, g.object, g.form_closure, g.provenance.seed);
  const auto add = [&](double x) { out += fmt::format("|{:x}", std::bit_cast<std::uint64_t>(x)); };
  const auto add_all = [&](const auto& m) {
    out += fmt::format("|n{}", m.size());
    for (Eigen::Index i = 0; i < m.size(); ++i) add(m.data()[i]);
  };
  add(g.object_scale);
  add_all(g.X_OH_pregrasp.matrix());
  add_all(g.X_OH.matrix());
  for (const NamedValues* values : {&g.pregrasp_joints, &g.grasp_joints})
    for (const auto& [name, value] : *values) {
      out += "|" + name;
      add(value);
    }
  for (const VecX* v : {&g.pregrasp_dofs, &g.grasp_dofs, &g.amplitudes}) add_all(*v);
  for (const GraspContact& c : g.contacts) {
    out += fmt::format("|{}|{}", c.link, c.patch);
    add_all(c.point.p_OC);
    add_all(c.point.n_OC);
    add(c.point.mu);
    add(c.point.torsion_length);
  }
  for (const double x : {g.energy, g.epsilon, g.volume, g.max_penetration}) add(x);
  return out + "|" + g.provenance.planner + "|" + g.provenance.options_digest + "|" + g.provenance.version;
}

}  // namespace eigengrasp::testing
