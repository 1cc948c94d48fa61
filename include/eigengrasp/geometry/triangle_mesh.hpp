// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// Axis-aligned box [m]; empty() where nothing was added.
struct Box {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return (min.array() > max.array()).any(); }
  bool contains(const Vec3& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
  Vec3 center() const { return 0.5 * (min + max); }
  Vec3 size() const { return max - min; }
  double diagonal() const { return empty() ? 0.0 : size().norm(); }
  void add(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  void add(const Box& b) {
    min = min.cwiseMin(b.min);
    max = max.cwiseMax(b.max);
  }
};

/// Triangles over shared vertices [m]. Plain data; may be a polygon soup. Counter-clockwise seen from outside
/// where the mesh has an outside.
struct TriangleMesh {
  using Triangle = std::array<std::int32_t, 3>;

  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;

  bool empty() const { return triangles.empty(); }
  /// Corner k in {0, 1, 2} of triangle t.
  const Vec3& corner(std::size_t t, int k) const {
    return vertices[static_cast<std::size_t>(triangles[t][static_cast<std::size_t>(k)])];
  }
};

/// Twice the area [m^2] times the unit normal of triangle t; zero for a degenerate one.
Vec3 area_normal(const TriangleMesh& mesh, std::size_t t);

/// Box of all vertices.
Box bounding_box(const TriangleMesh& mesh);

/// Sum of the triangle areas [m^2].
double surface_area(const TriangleMesh& mesh);

/// Moves every vertex p to scale * (X * p).
void transform(TriangleMesh& mesh, const Pose& X, double scale = 1.0);

/// Adds the triangles of b to a; vertices are not merged.
void append(TriangleMesh& a, const TriangleMesh& b);

/// Merges vertices that lie within tolerance [m] of each other (grid hash; exactly equal ones for 0), drops
/// triangles that lose an edge by it, and drops vertices that no triangle uses.
void weld(TriangleMesh& mesh, double tolerance);

}  // namespace eigengrasp
