// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cmath>
#include <set>

#include "eigengrasp/modeling/mesh_tools.hpp"

namespace eigengrasp::modeling {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// A directed edge and the triangle it belongs to; sorting brings both directions together.
struct Side {
  std::int32_t low, high;
  std::size_t triangle;
  bool operator<(const Side& o) const {
    if (low != o.low) return low < o.low;
    if (high != o.high) return high < o.high;
    return triangle < o.triangle;
  }
};

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// The triangle turned round so that it starts with its corner off the edge.
TriangleMesh::Triangle from_apex(const TriangleMesh::Triangle& t, const Side& edge) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (t[k] != edge.low && t[k] != edge.high) return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
  }
  return t;
}

/// Do the two triangles get better shaped by the flip, on nearly the same surface?
bool flip_helps(const TriangleMesh& mesh, const std::array<TriangleMesh::Triangle, 4>& t, double min_cosine) {
  std::array<double, 4> quality{};
  std::array<Vec3, 4> normal;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = mesh.vertices[at(t[i][0])], &b = mesh.vertices[at(t[i][1])],
               &c = mesh.vertices[at(t[i][2])];
    quality[i] = triangle_quality(a, b, c);
    normal[i] = (b - a).cross(c - a);
  }
  if (std::min(quality[2], quality[3]) <= std::min(quality[0], quality[1]) + 1e-6) return false;
  const Vec3 mean = normal[0] + normal[1];  // weighted by area: the normal of a sliver says little
  for (const Vec3& n : normal) {
    const bool sliver = n.norm() < 0.2 * mean.norm();
    if (n.dot(mean) < (sliver ? 0.5 : min_cosine) * n.norm() * mean.norm()) return false;
  }
  return true;
}

}  // namespace

std::size_t flip_edges(TriangleMesh& mesh, double min_cosine) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<bool> touched(mesh.triangles.size(), false);
  std::set<std::pair<std::int32_t, std::int32_t>> made;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const std::size_t left = sides[i].triangle, right = sides[i + 1].triangle;
    if (touched[left] || touched[right]) continue;
    const auto a = from_apex(mesh.triangles[left], sides[i]), b = from_apex(mesh.triangles[right], sides[i]);
    const std::pair<std::int32_t, std::int32_t> edge = std::minmax(std::int32_t{a[0]}, std::int32_t{b[0]});
    const auto known = std::lower_bound(sides.begin(), sides.end(), Side{edge.first, edge.second, 0});
    const bool exists = known != sides.end() && known->low == edge.first && known->high == edge.second;
    if (exists || made.contains(edge)) continue;
    const TriangleMesh::Triangle c{a[0], a[1], b[0]}, d{b[0], b[1], a[0]};
    if (!flip_helps(mesh, {a, b, c, d}, min_cosine)) continue;
    mesh.triangles[left] = c;
    mesh.triangles[right] = d;
    touched[left] = touched[right] = true;
    made.insert(edge);
    ++count;
  }
  return count;
}

}  // namespace eigengrasp::modeling
