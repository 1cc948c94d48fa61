// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "geometry/nearest_triangles.hpp"

#include <algorithm>

#include "core/variants.hpp"
#include "geometry/kernel/point_looks.hpp"

namespace eigengrasp::detail {

namespace {

static_assert(most_points == kernel::n_lanes);

void put(const Vec3& p, float* to) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(p[k]);
}

double squared_distance(const Box& box, const Vec3& p) {
  return (box.min - p).cwiseMax(p - box.max).cwiseMax(Vec3::Zero()).squaredNorm();
}

}  // namespace

std::array<int, most_points> find_nearest_triangles(const MeshBvh& bvh, const Vec3& about,
                                                    const std::array<Vec3, most_points>& points,
                                                    double max_distance) {
  static const point_kernel::Functions& functions = EIGENGRASP_VARIANT(point_kernel, best_instruction_set());
  point_kernel::Points p{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 d = points[i] - about;
    p.x[i] = static_cast<float>(d.x());
    p.y[i] = static_cast<float>(d.y());
    p.z[i] = static_cast<float>(d.z());
    p.distance2[i] = static_cast<float>(max_distance * max_distance);
    p.height2[i] = -1.0F;
    p.triangle[i] = -1;
  }
  int stack[128];  // the depth of a hierarchy is below log2 of the triangle count + 1
  int top = 0;
  if (!bvh.empty()) stack[top++] = 0;
  while (top > 0) {
    const MeshBvh::Node& node = bvh.nodes()[static_cast<std::size_t>(stack[--top])];
    float box[6];
    put(node.box.min - about, box);
    put(node.box.max - about, box + 3);
    if (!functions.reach_box(p, box)) continue;
    if (node.count == 0) {  // the nearer child is taken first
      const auto left = static_cast<std::size_t>(node.left);
      const bool left_first = squared_distance(bvh.nodes()[left].box, about) <=
                              squared_distance(bvh.nodes()[left + 1].box, about);
      stack[top++] = node.left + (left_first ? 1 : 0);
      stack[top++] = node.left + (left_first ? 0 : 1);
      continue;
    }
    for (int i = node.left; i < node.left + node.count; ++i) {
      const int t = bvh.triangle_at(i);
      const TriangleCorners& c = bvh.corners(t);
      float corners[9];
      put(c.a - about, corners);
      put(c.b - about, corners + 3);
      put(c.c - about, corners + 6);
      functions.meet_triangle(p, corners, t);
    }
  }
  std::array<int, most_points> triangles;
  std::copy(std::begin(p.triangle), std::end(p.triangle), triangles.begin());
  return triangles;
}

}  // namespace eigengrasp::detail
