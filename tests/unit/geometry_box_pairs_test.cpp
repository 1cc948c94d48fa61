// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Packs of oriented boxes against the distances of what they hold, and one instruction set against another.
#include "geometry/box_pairs.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/variants.hpp"
#include "geometry/box_descent.hpp"
#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using detail::BoxPairs;
using testing::any_pose;
using testing::random_direction;

constexpr double margin = 0.00005;

/// All leaves below a node.
void add_leaves(const MeshBvh& bvh, int node, std::vector<const MeshBvh::Node*>& leaves) {
  const MeshBvh::Node& n = bvh.nodes()[static_cast<std::size_t>(node)];
  if (n.count > 0) return leaves.push_back(&n);
  for (int child = 0; child < 2; ++child) add_leaves(bvh, n.left + child, leaves);
}

TriangleMesh part_of(const MeshBvh& bvh, int node) {
  std::vector<const MeshBvh::Node*> leaves;
  add_leaves(bvh, node, leaves);
  TriangleMesh mesh;
  for (const MeshBvh::Node* leaf : leaves)
    for (int k = leaf->left; k < leaf->left + leaf->count; ++k) {
      const TriangleCorners& t = bvh.corners(bvh.triangle_at(k));
      const int first = static_cast<int>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), {t.a, t.b, t.c});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  return mesh;
}

Screw any_joint(RandomStream& random) {
  const Vec3 w = random.uniform(0.2, 1.0) * random_direction(random);
  return {w, Vec3(0.05 * random_direction(random)).cross(w)};
}

Pose moved(const Screw& s, double t) {
  const Vec3 axis = s.angular.normalized();
  const Vec3 point = s.angular.cross(s.linear) / s.angular.squaredNorm();
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(t * s.angular.norm(), axis).toRotationMatrix();
  X.translation() = point - X.linear() * point;
  return X;
}

TEST(BoxPairs, GapsAndTimesAreLowerBoundsVsExactDistances) {
  RandomStream random{21};
  const MeshBvh a(testing::torus_mesh(0.03, 0.01, 24));
  const MeshBvh b(testing::ball_mesh(0.02, 10));
  int apart = 0;
  for (int i = 0; i < 40; ++i) {
    const Pose X_AB = any_pose(random, 0.08);
    BoxPairs pairs(a, b, X_AB);
    const Screw joint = any_joint(random);
    pairs.set_motion({{}, {&joint, 1}, joint.angular.squaredNorm() * 0.3}, margin);
    int nodes[BoxPairs::most][2];
    for (auto& pair : nodes) {
      pair[0] = static_cast<int>(random.uniform(0.0, static_cast<double>(a.nodes().size())));
      pair[1] = static_cast<int>(random.uniform(0.0, static_cast<double>(b.nodes().size())));
      pairs.add(pair[0], pair[1]);
    }
    pairs.look_at_times(0.1);
    for (int k = 0; k < BoxPairs::most; ++k) {
      const MeshBvh part_a(part_of(a, nodes[k][0]));
      const MeshBvh part_b(part_of(b, nodes[k][1]));
      EXPECT_LE(pairs.gap(k), closest_pair(part_a, part_b, X_AB).distance + 1e-9);
      const double time = std::min(pairs.time(k), 1.0);
      apart += time > 0.0;
      if (time == 0.0) continue;
      for (const double share : {0.5, 1.0})
        EXPECT_GE(closest_pair(part_a, part_b, moved(joint, share * time) * X_AB).distance, margin - 1e-7);
    }
  }
  EXPECT_GT(apart, 200);
}

TEST(BoxPairs, AllInstructionSetsGiveTheSameBits) {
  RandomStream random{22};
  box_kernel::Placement place{};
  box_kernel::Joint joints[3] = {};
  for (int i = 0; i < 200; ++i) {
    const Pose X = any_pose(random, 0.1);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) place.rotation[r][c] = static_cast<float>(X.linear()(r, c));
      place.origin[r] = static_cast<float>(X.translation()[r]);
    }
    for (box_kernel::Joint& j : joints) {
      const Vec3 axis = random_direction(random);
      for (int k = 0; k < 3; ++k) {
        j.angular[k] = j.axis[k] = static_cast<float>(axis[k]);
        j.linear[k] = static_cast<float>(random.uniform(-0.1, 0.1));
      }
      j.spin = 1.0f;
    }
    constexpr int n_boxes = 40;
    std::vector<float> boxes[2];
    for (auto& of : boxes)
      for (int k = 0; k < n_boxes * box_kernel::box_stride; ++k) {
        const int at = k % box_kernel::box_stride;
        of.push_back(static_cast<float>(at < 12   ? random.uniform(-1.0, 1.0)
                                        : at < 16 ? random.uniform(0.0, 0.01)
                                                  : random.uniform(-0.1, 0.1)));
      }
    box_kernel::Pairs pairs{};
    pairs.boxes_a = boxes[0].data();
    pairs.boxes_b = boxes[1].data();
    for (int lane = 0; lane < kernel::n_lanes; ++lane) {
      pairs.a[lane] = static_cast<int>(random.uniform(0.0, n_boxes));
      pairs.b[lane] = static_cast<int>(random.uniform(0.0, n_boxes));
    }
    const box_kernel::Motion motion{joints, i % 3, 3, 0.00005f, 0.2f, 0.1f};
    box_kernel::Pairs expected = pairs;
    box_kernel::baseline_functions.times(place, motion, expected);
    for (const InstructionSet set : available_instruction_sets()) {
      if (set == InstructionSet::baseline) continue;
      const auto& functions = EIGENGRASP_VARIANT(box_kernel, set);
      box_kernel::Pairs found = pairs;
      functions.times(place, motion, found);
      EXPECT_EQ(std::memcmp(found.gap, expected.gap, sizeof found.gap), 0) << i;
      EXPECT_EQ(std::memcmp(found.time, expected.time, sizeof found.time), 0) << i;
      functions.gaps(place, found);
      EXPECT_EQ(std::memcmp(found.gap, expected.gap, sizeof found.gap), 0) << i;
    }
  }
}

}  // namespace
}  // namespace eigengrasp
