// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cmath>
#include <cstdint>
#include <numbers>

#include "surface.hpp"

namespace eigengrasp {

namespace {

constexpr int kSides = 48;

Vec3 on_circle(int side, double radius, double z) {
  const double angle = 2.0 * std::numbers::pi * side / kSides;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Closes a ring of kSides vertices that begins at `first` with a fan around a new vertex.
void add_fan(TriangleMesh& mesh, int first, const Vec3& center, bool upwards) {
  const auto c = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.push_back(center);
  for (int s = 0; s < kSides; ++s) {
    const auto a = static_cast<std::int32_t>(first + s);
    const auto b = static_cast<std::int32_t>(first + (s + 1) % kSides);
    if (upwards)
      mesh.triangles.push_back({c, a, b});
    else
      mesh.triangles.push_back({c, b, a});
  }
}

void add_ring(TriangleMesh& mesh, double radius, double z) {
  for (int s = 0; s < kSides; ++s) mesh.vertices.push_back(on_circle(s, radius, z));
}

/// Joins two rings, the upper one added after the lower one.
void add_band(TriangleMesh& mesh, int lower, int upper) {
  for (int s = 0; s < kSides; ++s) {
    const int next = (s + 1) % kSides;
    mesh.triangles.push_back({lower + s, lower + next, upper + next});
    mesh.triangles.push_back({lower + s, upper + next, upper + s});
  }
}

}  // namespace

TriangleMesh unit_ball() {
  constexpr int kRings = 23;
  TriangleMesh mesh;
  for (int r = 0; r < kRings; ++r) {
    const double angle = std::numbers::pi * (r + 1) / (kRings + 1);
    add_ring(mesh, std::sin(angle), -std::cos(angle));
    if (r > 0) add_band(mesh, (r - 1) * kSides, r * kSides);
  }
  add_fan(mesh, 0, -Vec3::UnitZ(), false);
  add_fan(mesh, (kRings - 1) * kSides, Vec3::UnitZ(), true);
  return mesh;
}

TriangleMesh unit_cone() {
  TriangleMesh mesh;
  add_ring(mesh, 1.0, 1.0);
  add_fan(mesh, 0, Vec3::Zero(), false);
  add_fan(mesh, 0, Vec3::UnitZ(), true);
  return mesh;
}

TriangleMesh unit_cylinder() {
  TriangleMesh mesh;
  add_ring(mesh, 1.0, 0.0);
  add_ring(mesh, 1.0, 1.0);
  add_band(mesh, 0, kSides);
  add_fan(mesh, 0, Vec3::Zero(), false);
  add_fan(mesh, kSides, Vec3::UnitZ(), true);
  return mesh;
}

}  // namespace eigengrasp
