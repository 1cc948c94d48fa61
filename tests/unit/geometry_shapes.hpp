// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp::testing {

/// Closed box from the origin to the given corner, counter-clockwise from outside.
inline TriangleMesh box_shape(const Vec3& size = Vec3::Ones()) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(size.x() * (i & 1), size.y() * ((i >> 1) & 1), size.z() * (i >> 2));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Unit sphere about the origin: an octahedron, each triangle split in four `levels` times.
inline TriangleMesh sphere_shape(int levels) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [it, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(mesh.vertices.size()));
      if (added)
        mesh.vertices.push_back((mesh.vertices[std::size_t(a)] + mesh.vertices[std::size_t(b)]).normalized());
      return it->second;
    };
    std::vector<TriangleMesh::Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// The same triangles, none of which shares a vertex.
inline TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(mesh.corner(t, k));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

inline Pose random_pose(RandomStream& random, double reach) {
  Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  return make_pose(q, reach * Vec3(random.normal(), random.normal(), random.normal()));
}

inline void expect_near(const Vec3& actual, const Vec3& expected, double tolerance) {
  EXPECT_LE((actual - expected).norm(), tolerance)
      << actual.transpose() << " where " << expected.transpose() << " was expected";
}

}  // namespace eigengrasp::testing
