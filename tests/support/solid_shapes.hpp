// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp::testing {

/// Points (radius, height) of a profile in the half plane.
using Profile = std::vector<std::pair<double, double>>;

/// Turns a profile about z. Its outside is to the right of its direction; `closed` joins the last to the
/// first point. Points on the axis have radius 0.
inline TriangleMesh revolve(const Profile& profile, int sides, bool closed = false) {
  TriangleMesh mesh;
  std::vector<std::vector<std::int32_t>> rings;
  for (const auto& [r, z] : profile) {
    std::vector<std::int32_t> ring;
    for (int s = 0; s < sides; ++s) {
      if (r > 0.0 || s == 0) {
        const double a = 2.0 * std::numbers::pi * s / sides;
        mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), z);
      }
      ring.push_back(static_cast<std::int32_t>(mesh.vertices.size()) - 1);
    }
    rings.push_back(ring);
  }
  const std::size_t bands = closed ? rings.size() : rings.size() - 1;
  for (std::size_t i = 0; i < bands; ++i) {
    const auto& low = rings[i];
    const auto& high = rings[(i + 1) % rings.size()];
    for (std::size_t s = 0; s < low.size(); ++s) {
      const std::size_t next = (s + 1) % low.size();
      if (low[s] != low[next]) mesh.triangles.push_back({low[s], low[next], high[next]});
      if (high[s] != high[next]) mesh.triangles.push_back({low[s], high[next], high[s]});
    }
  }
  return mesh;
}

/// Ring of the given radii about z.
inline TriangleMesh torus_mesh(double ring_radius, double tube_radius, int sides = 48) {
  Profile profile;
  for (int i = 0; i < sides / 2; ++i) {
    const double a = 4.0 * std::numbers::pi * i / sides;
    profile.emplace_back(ring_radius + tube_radius * std::cos(a), tube_radius * std::sin(a));
  }
  return revolve(profile, sides, true);
}

/// Closed cylinder about z from height 0.
inline TriangleMesh cylinder_mesh(double radius, double height, int sides = 48) {
  return revolve({{0.0, 0.0}, {radius, 0.0}, {radius, height}, {0.0, height}}, sides);
}

/// Cup that opens upwards, with a wall and a bottom of the given thickness.
inline TriangleMesh cup_mesh(double radius, double height, double wall, int sides = 48) {
  return revolve({{0.0, 0.0},
                  {radius, 0.0},
                  {radius, height},
                  {radius - wall, height},
                  {radius - wall, wall},
                  {0.0, wall}},
                 sides);
}

/// Ball-ended cylinder about z; the centres of the balls are at +- half_length.
inline TriangleMesh capsule_mesh(double radius, double half_length, int sides = 32) {
  Profile profile;
  const int rings = sides / 4;
  for (const double end : {-1.0, 1.0})
    for (int i = 0; i <= rings; ++i) {
      const double a = 0.5 * std::numbers::pi * (end > 0.0 ? i : i - rings) / rings;
      const bool pole = std::abs(std::abs(a) - 0.5 * std::numbers::pi) < 1e-9;
      profile.emplace_back(pole ? 0.0 : radius * std::cos(a), end * half_length + radius * std::sin(a));
    }
  return revolve(profile, sides);
}

inline TriangleMesh moved(TriangleMesh mesh, const Pose& X) {
  transform(mesh, X);
  return mesh;
}

inline Vec3 random_direction(RandomStream& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

/// Any orientation, position within a box of the given half side.
inline Pose any_pose(RandomStream& random, double reach) {
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  return make_pose(q, reach * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
}

inline Vec3 any_point(RandomStream& random, const Box& box, double margin) {
  Vec3 p;
  for (Eigen::Index i = 0; i < 3; ++i) p[i] = random.uniform(box.min[i] - margin, box.max[i] + margin);
  return p;
}

/// A point of the surface, every one as likely.
inline Vec3 any_surface_point(RandomStream& random, const TriangleMesh& mesh) {
  double left = random.uniform(0.0, 2.0 * surface_area(mesh));
  std::size_t t = 0;
  while (t + 1 < mesh.triangles.size() && left > area_normal(mesh, t).norm())
    left -= area_normal(mesh, t++).norm();
  const double u = std::sqrt(random.uniform());
  const double v = random.uniform();
  return (1.0 - u) * mesh.corner(t, 0) + u * (1.0 - v) * mesh.corner(t, 1) + u * v * mesh.corner(t, 2);
}

}  // namespace eigengrasp::testing
