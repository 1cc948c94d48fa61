// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The links of data/hands are shaped like those of GraspIt!'s robots, as far as they can be seen from outside
// of the hand at rest: distance of points of one surface from the other, both ways.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <iostream>
#include <numbers>

#include "eigengrasp/geometry/mesh_bvh.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "support/solid_shapes.hpp"
#include "support/test_data.hpp"

namespace eigengrasp {
namespace {

struct ShippedHand {
  const char* name;
  const char* graspit_robot;
};

void PrintTo(const ShippedHand& hand, std::ostream* out) {
  *out << hand.name;
}

Pose pose_of(const YAML::Node& X) {
  const auto xyz = X["xyz"].as<std::vector<double>>();
  const auto rpy = X["rpy"].as<std::vector<double>>();
  return Eigen::Translation3d(xyz[0], xyz[1], xyz[2]) * Eigen::AngleAxisd(rpy[2], Vec3::UnitZ()) *
         Eigen::AngleAxisd(rpy[1], Vec3::UnitY()) * Eigen::AngleAxisd(rpy[0], Vec3::UnitX()) *
         Pose::Identity();
}

/// Whether the segment from p to q meets the surface.
bool blocks(const MeshBvh& bvh, const Vec3& p, const Vec3& q) {
  const Vec3 d = q - p;
  std::vector<int> open{0};
  while (!open.empty()) {
    const MeshBvh::Node& node = bvh.nodes()[static_cast<std::size_t>(open.back())];
    open.pop_back();
    double enter = 0.0, leave = 1.0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double a = (node.box.min[k] - 1e-9 - p[k]) / d[k];
      const double b = (node.box.max[k] + 1e-9 - p[k]) / d[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) continue;
    if (node.count == 0) {
      open.push_back(node.left);
      open.push_back(node.left + 1);
    }
    Vec3 hit;
    for (int i = 0; i < node.count; ++i)
      if (segment_hits_triangle(p, q, bvh.corners(bvh.triangle_at(node.left + i)), hit)) return true;
  }
  return false;
}

/// A hand at rest, all links in its base frame.
class AssembledHand {
 public:
  explicit AssembledHand(HandModel hand) : model(std::move(hand)) {
    compute_link_poses(model, joint_values(model, model.rest_posture()), Pose::Identity(), X_HL);
    for (std::size_t i = 0; i < model.links.size(); ++i)
      surfaces.emplace_back(testing::moved(model.links[i].mesh, X_HL[i]));
  }

  /// Whether a point of a surface with outward normal n sees a tenth of its half of the outside at least:
  /// what is seen through a crack between links only does not count.
  bool visible(const Vec3& p_H, const Vec3& n) const {
    constexpr int rays = 64;
    int seen = 0, cast = 0;
    for (int i = 0; i < rays; ++i) {
      // Equally spread over the sphere (Fibonacci), in no way aligned with the hand.
      const double z = 1.0 - (2.0 * i + 1.0) / rays;
      const double a = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i + 0.1;
      const double r = std::sqrt(1.0 - z * z);
      const Vec3 direction(r * std::cos(a), r * std::sin(a), z);
      if (direction.dot(n) < 0.15) continue;
      ++cast;
      const Vec3 start = p_H + 2e-5 * n;
      bool blocked = false;
      for (const MeshBvh& s : surfaces)
        blocked = blocked || (!s.empty() && blocks(s, start, start + direction));
      seen += !blocked;
    }
    return 10 * seen >= cast;
  }

  HandModel model;
  std::vector<Pose> X_HL;
  std::vector<MeshBvh> surfaces;
};

struct Spread {
  double median = 0.0;  ///< [mm]
  double p95 = 0.0;
  std::size_t samples = 0;
};

/// Distances from the visible points of a link to a link of another hand; X_BA is the pose of the link's
/// frame in the other's.
Spread distances(const AssembledHand& a, int link_a, const AssembledHand& b, int link_b, const Pose& X_BA) {
  constexpr int samples = 1500;
  RandomStream random{7};
  const auto i = static_cast<std::size_t>(link_a);
  const TriangleMesh& mesh = a.model.links[i].mesh;
  const MeshBvh other(b.model.links[static_cast<std::size_t>(link_b)].mesh);
  const MeshBvh own(mesh);
  std::vector<double> found;
  for (int k = 0; k < samples; ++k) {
    const Vec3 p = testing::any_surface_point(random, mesh);
    const TriangleCorners& t = own.corners(own.closest_point(p).triangle);
    Vec3 n = (t.b - t.a).cross(t.c - t.a).normalized();
    // Some faces of GraspIt!'s look the wrong way.
    if (std::abs(own.winding_number(p + 1e-4 * n)) > std::abs(own.winding_number(p - 1e-4 * n))) n = -n;
    if (!a.visible(a.X_HL[i] * p, a.X_HL[i].linear() * n)) continue;
    found.push_back(1e3 * other.closest_point(X_BA * p).distance);
  }
  std::sort(found.begin(), found.end());
  if (found.empty()) return {};
  return {found[found.size() / 2], found[found.size() * 95 / 100], found.size()};
}

class ShippedHandsLikeness : public ::testing::TestWithParam<ShippedHand> {};

TEST_P(ShippedHandsLikeness, LinksAreShapedLikeGraspits) {
  const auto robot =
      testing::test_data(std::filesystem::path("graspit/models/robots") / GetParam().graspit_robot);
  EIGENGRASP_REQUIRE_DATA(robot);
  const auto folder = testing::source_path("data/hands") / GetParam().name;
  const AssembledHand ours(load_hand(folder)), theirs(load_hand(robot));
  std::cout << fmt::format("{:18} | ours -> GraspIt! [mm]     | GraspIt! -> ours [mm]\n", GetParam().name);
  std::cout << fmt::format("{:18} | median   p95   samples | median   p95   samples\n", "");
  for (const YAML::Node& item : YAML::LoadFile((folder / "graspit_links.yaml").string())) {
    const auto name = item["link"].as<std::string>();
    const auto graspit_name = item["graspit_link"].as<std::string>();
    const int link = ours.model.find_link(name);
    int other = 0;
    Pose X_LG = pose_of(item["X"]);  // frame of GraspIt!'s link in ours
    if (graspit_name != "palm") {
      const int frame = theirs.model.find_frame(graspit_name);
      ASSERT_GE(frame, 0) << graspit_name;
      const HandFrame& f = theirs.model.frames[static_cast<std::size_t>(frame)];
      other = f.link;
      X_LG = X_LG * f.X_LF.inverse();
    }
    ASSERT_GE(link, 0) << name;
    if (theirs.model.links[static_cast<std::size_t>(other)].mesh.empty()) continue;
    ASSERT_FALSE(ours.model.links[static_cast<std::size_t>(link)].mesh.empty()) << name;
    const Spread there = distances(ours, link, theirs, other, X_LG.inverse());
    const Spread back = distances(theirs, other, ours, link, X_LG);
    std::cout << fmt::format("{:18} | {:6.2f} {:6.2f} {:8}   | {:6.2f} {:6.2f} {:8}\n", name, there.median,
                             there.p95, there.samples, back.median, back.p95, back.samples);
    const double p95_limit = name == "palm" ? 8.0 : 6.0;
    for (const Spread& s : {there, back}) {
      EXPECT_GT(s.samples, 30u) << name;
      EXPECT_LE(s.median, 2.0) << name;
      EXPECT_LE(s.p95, p95_limit) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hands, ShippedHandsLikeness,
                         ::testing::Values(ShippedHand{"barrett-metal", "Barrett/Barrett.xml"},
                                           ShippedHand{"barrett-rubber", "Barrett/Barrett.xml"},
                                           ShippedHand{"dlr", "DLR/DLR.xml"},
                                           ShippedHand{"robonaut", "Robonaut/Robonaut.xml"},
                                           ShippedHand{"human", "HumanHand/HumanHand20DOF.xml"}),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace eigengrasp
