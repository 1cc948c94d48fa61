// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Against grasps that GraspIt! closed on its own models (reference/grasps.jsonl): wrenches from its own code,
// put through Qhull (Qt Qx) for `epsilon_qhull`. Lengths are millimetres there; torques are about the centre
// of mass, over max_radius.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "eigengrasp/quality/wrench_space.hpp"
#include "support/test_data.hpp"

namespace eigengrasp {
namespace {

using nlohmann::json;

constexpr double kMillimetre = 1e-3;

struct ReferenceGrasp {
  std::string name;
  double epsilon = 0.0;
  double volume = 0.0;
  WrenchSpaceOptions options;
  std::vector<ContactPoint> contacts;
  std::vector<std::vector<Vec6>> wrenches;  // of each contact

  std::vector<Vec6> all_wrenches() const {
    std::vector<Vec6> all;
    for (const auto& w : wrenches) all.insert(all.end(), w.begin(), w.end());
    return all;
  }
};

Vec3 read_vec3(const json& j) {
  return Vec3(j[0].get<double>(), j[1].get<double>(), j[2].get<double>());
}

// The torsion length is not in the file: the first edge of a soft contact is the pole of its ellipsoid, whose
// torque is n mu e alone beside that of the normal force.
double torsion_length(const ContactPoint& c, const WrenchSpaceOptions& o, const std::vector<Vec6>& wrenches) {
  if (wrenches.size() != 20 || c.mu == 0.0) return 0.0;
  const Vec6& pole = wrenches.front();
  const Vec3 spin = pole.tail<3>() - (c.p_OC - o.torque_origin_O).cross(pole.head<3>()) / o.torque_scale;
  return std::abs(spin.dot(c.n_OC)) * o.torque_scale / c.mu;
}

ReferenceGrasp read_grasp(const json& j, std::size_t line) {
  ReferenceGrasp g;
  g.name = "line " + std::to_string(line) + " " + j["hand"].get<std::string>() + " " +
           j["object"].get<std::string>();
  g.epsilon = j["epsilon_qhull"].get<double>();
  g.volume = j["volume"].get<double>();
  g.options.torque_origin_O = read_vec3(j["centre_of_mass"]) * kMillimetre;
  g.options.torque_scale = j["max_radius"].get<double>() * kMillimetre;
  for (const json& c : j["contacts"]) {
    ContactPoint contact;
    contact.p_OC = read_vec3(c["position"]) * kMillimetre;
    contact.n_OC = read_vec3(c["normal"]).normalized();
    contact.mu = c["mu"].get<double>();
    std::vector<Vec6> wrenches;
    for (const json& w : c["wrenches"]) {
      Vec6 v;
      for (int k = 0; k < 6; ++k) v[k] = w[static_cast<std::size_t>(k)].get<double>();
      wrenches.push_back(v);
    }
    contact.torsion_length = torsion_length(contact, g.options, wrenches);
    g.contacts.push_back(contact);
    g.wrenches.push_back(std::move(wrenches));
  }
  return g;
}

const std::vector<ReferenceGrasp>& reference_grasps(const std::filesystem::path& file) {
  static const std::vector<ReferenceGrasp> grasps = [&] {
    std::vector<ReferenceGrasp> all;
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) all.push_back(read_grasp(json::parse(line), all.size() + 1));
    return all;
  }();
  return grasps;
}

TEST(QualityReference, EpsilonOfItsWrenches) {
  const auto file = testing::test_data("reference/grasps.jsonl");
  EIGENGRASP_REQUIRE_DATA(file);
  double worst = 0.0;
  int closed = 0;
  for (const ReferenceGrasp& g : reference_grasps(file)) {
    const WrenchSpaceQuality quality = compute_epsilon(g.all_wrenches());
    EXPECT_NEAR(quality.epsilon, g.epsilon, 1e-6) << g.name;
    EXPECT_EQ(quality.form_closure, g.epsilon >= 1e-6) << g.name << " epsilon " << quality.epsilon;
    worst = std::max(worst, std::abs(quality.epsilon - g.epsilon));
    closed += quality.form_closure;
  }
  std::printf("worst residual %.3g, %d closed\n", worst, closed);
}

// Distance of an edge from the limit surface of the contact, in units of mu: tells whether the ellipsoid is
// right, however the tangents are turned.
TEST(QualityReference, EdgesAreOursUpToARotationAboutTheNormal) {
  const auto file = testing::test_data("reference/grasps.jsonl");
  EIGENGRASP_REQUIRE_DATA(file);
  double worst = 0.0;
  for (const ReferenceGrasp& g : reference_grasps(file)) {
    for (std::size_t i = 0; i < g.contacts.size(); ++i) {
      const ContactPoint& c = g.contacts[i];
      std::vector<Vec6> ours;
      append_edge_wrenches(c, g.options, ours);
      if (c.mu == 0.0) continue;
      ASSERT_EQ(ours.size(), g.wrenches[i].size()) << g.name;
      const auto invariants = [&](const Vec6& w) {
        const Vec3 lever = (c.p_OC - g.options.torque_origin_O) / g.options.torque_scale;
        const Vec3 spin = w.tail<3>() - lever.cross(Vec3(w.head<3>()));
        const Vec3 f = w.head<3>();
        return Vec3(f.dot(c.n_OC), (f - f.dot(c.n_OC) * c.n_OC).norm(), std::abs(spin.dot(c.n_OC)));
      };
      for (std::size_t k = 0; k < ours.size(); ++k) {
        const double error = (invariants(ours[k]) - invariants(g.wrenches[i][k])).norm();
        EXPECT_LT(error, 2e-5) << g.name << " contact " << i << " edge " << k;
        worst = std::max(worst, error);
      }
    }
  }
  std::printf("worst residual %.3g\n", worst);
}

// Turns the edges of a contact about its normal, so that edge k lies where the other set has it. The cone is
// the same; where on the circle its edges begin is free.
std::vector<Vec6> turned_to(const std::vector<Vec6>& target, std::vector<Vec6> edges, const ContactPoint& c,
                            const WrenchSpaceOptions& o) {
  const std::size_t k = edges.size() == 20 ? 1 : 0;  // the pole of an ellipsoid has no direction
  const auto tangential = [&](const Vec6& w) {
    const Vec3 f = w.head<3>();
    return Vec3(f - f.dot(c.n_OC) * c.n_OC);
  };
  const Vec3 from = tangential(edges[k]);
  const Vec3 to = tangential(target[k]);
  const double angle = std::atan2(c.n_OC.dot(from.cross(to)), from.dot(to));
  const Mat3 R = Eigen::AngleAxisd(angle, c.n_OC).toRotationMatrix();
  const Vec3 lever = (c.p_OC - o.torque_origin_O) / o.torque_scale;
  for (Vec6& w : edges) {
    const Vec3 force = w.head<3>();
    const Vec3 spin = w.tail<3>() - lever.cross(force);
    w.head<3>() = R * force;
    w.tail<3>() = lever.cross(Vec3(R * force)) + spin;
  }
  return edges;
}

TEST(QualityReference, EpsilonOfItsContactsWithOurEdgesAtItsPhase) {
  const auto file = testing::test_data("reference/grasps.jsonl");
  EIGENGRASP_REQUIRE_DATA(file);
  double worst = 0.0;
  for (const ReferenceGrasp& g : reference_grasps(file)) {
    std::vector<Vec6> all;
    for (std::size_t i = 0; i < g.contacts.size(); ++i) {
      std::vector<Vec6> ours;
      append_edge_wrenches(g.contacts[i], g.options, ours);
      ours = turned_to(g.wrenches[i], ours, g.contacts[i], g.options);
      all.insert(all.end(), ours.begin(), ours.end());
    }
    const WrenchSpaceQuality quality = compute_epsilon(all);
    EXPECT_NEAR(quality.epsilon, g.epsilon, 2e-5) << g.name;
    EXPECT_EQ(quality.form_closure, g.epsilon >= 1e-6) << g.name << " epsilon " << quality.epsilon;
    worst = std::max(worst, std::abs(quality.epsilon - g.epsilon));
  }
  std::printf("worst residual %.3g\n", worst);
}

// From the contacts alone, with edges of our own making. They begin where GraspIt!'s do (contact_tangents),
// which matters: a cone of eight edges turned by half a step moves epsilon by up to 0.012 here. The true cone
// bounds both.
TEST(QualityReference, EpsilonOfItsContactsWithOurEdges) {
  const auto file = testing::test_data("reference/grasps.jsonl");
  EIGENGRASP_REQUIRE_DATA(file);
  double worst = 0.0;
  for (const ReferenceGrasp& g : reference_grasps(file)) {
    const WrenchSpaceQuality quality = compute_epsilon(g.contacts, g.options);
    WrenchSpaceOptions exact = g.options;
    exact.cone = ConeModel::exact;
    EXPECT_NEAR(quality.epsilon, g.epsilon, 0.01) << g.name;
    EXPECT_LE(quality.epsilon, compute_epsilon(g.contacts, exact).epsilon + 1e-5) << g.name;
    EXPECT_EQ(quality.form_closure, g.epsilon >= 1e-6) << g.name;
    worst = std::max(worst, std::abs(quality.epsilon - g.epsilon));
  }
  std::printf("worst residual %.3g\n", worst);
}

// Its volume is that of a hull joggled by much more than ours; 0 where that failed, tiny where the set is
// flat.
TEST(QualityReference, VolumeOfItsWrenches) {
  const auto file = testing::test_data("reference/grasps.jsonl");
  EIGENGRASP_REQUIRE_DATA(file);
  double worst = 0.0;
  int compared = 0;
  const auto& grasps = reference_grasps(file);
  for (std::size_t i = 0; i < grasps.size(); i += 6) {
    const ReferenceGrasp& g = grasps[i];
    if (g.volume < 1e-3) continue;
    const double volume = compute_hull_volume(g.all_wrenches());
    EXPECT_LE(volume, 1.02 * g.volume) << g.name;
    EXPECT_GE(volume, (1.0 - 1e-4) * g.volume) << g.name;
    worst = std::max(worst, std::abs(volume - g.volume) / g.volume);
    ++compared;
  }
  EXPECT_GT(compared, 10);
  std::printf("worst relative residual %.3g of %d\n", worst, compared);
}

}  // namespace
}  // namespace eigengrasp
