// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "model_io/primitive_meshes.hpp"

#include <numbers>

namespace eigengrasp {

namespace {
constexpr int n_sides = 64;
constexpr int n_parallels = 31;

/// A solid of revolution about z: rings of (radius, height) from below to above, closed by its two poles.
TriangleMesh revolve(const std::vector<std::array<double, 2>>& rings, double bottom, double top) {
  TriangleMesh mesh;
  for (const auto& [radius, height] : rings) {
    for (int k = 0; k < n_sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / n_sides;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
  }
  mesh.vertices.emplace_back(0.0, 0.0, bottom);
  mesh.vertices.emplace_back(0.0, 0.0, top);
  const int south = static_cast<int>(mesh.vertices.size()) - 2, north = south + 1;
  const int last = n_sides * (static_cast<int>(rings.size()) - 1);
  for (int k = 0; k < n_sides; ++k) {
    const int next = (k + 1) % n_sides;
    mesh.triangles.push_back({south, next, k});
    mesh.triangles.push_back({north, last + k, last + next});
    for (int ring = 0; ring < last; ring += n_sides) {
      mesh.triangles.push_back({ring + k, ring + next, ring + n_sides + next});
      mesh.triangles.push_back({ring + k, ring + n_sides + next, ring + n_sides + k});
    }
  }
  return mesh;
}
}  // namespace

TriangleMesh box_mesh(const Vec3& sides) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    mesh.vertices.push_back(corner.cwiseProduct(sides));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh cylinder_mesh(double radius, double length) {
  return revolve({{radius, -0.5 * length}, {radius, 0.5 * length}}, -0.5 * length, 0.5 * length);
}

TriangleMesh sphere_mesh(double radius) {
  std::vector<std::array<double, 2>> rings;
  for (int i = 1; i <= n_parallels; ++i) {
    const double angle = std::numbers::pi * i / (n_parallels + 1);
    rings.push_back({radius * std::sin(angle), -radius * std::cos(angle)});
  }
  return revolve(rings, -radius, radius);
}

}  // namespace eigengrasp
