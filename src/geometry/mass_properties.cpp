// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/mass_properties.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

namespace {

/// Disjoint sets of vertices with path halving.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t find(std::int32_t v) {
    while (parent(v) != v) {
      parent(v) = parent(parent(v));
      v = parent(v);
    }
    return v;
  }
  void unite(std::int32_t a, std::int32_t b) { parent(find(a)) = find(b); }

 private:
  std::int32_t& parent(std::int32_t v) { return parent_[static_cast<std::size_t>(v)]; }
  std::vector<std::int32_t> parent_;
};

/// A side of a triangle, by its vertices in order; forward where the triangle walks from low to high.
struct Side {
  std::int32_t low, high;
  bool forward;
  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// All sides, those of one edge beside each other.
std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = t[k];
      const std::int32_t to = t[(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  return sides;
}

/// Edges and components of a welded mesh.
void inspect_topology(const TriangleMesh& mesh, MeshReport& report) {
  const std::vector<Side> sides = sorted_sides(mesh);
  bool closed = true;  // every edge is walked as often forwards as backwards
  report.consistent_orientation = true;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    int forward = 0;
    while (last < sides.size() && sides[last].same_edge(sides[first])) forward += sides[last++].forward;
    const int count = static_cast<int>(last - first);
    if (count == 1) ++report.boundary_edges;
    if (count > 2) ++report.non_manifold_edges;
    if (forward > 1 || count - forward > 1) report.consistent_orientation = false;
    if (2 * forward != count) closed = false;
  }
  report.watertight = closed && !sides.empty();

  UnionFind sets(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    sets.unite(t[0], t[1]);
    sets.unite(t[1], t[2]);
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    report.components += sets.find(static_cast<std::int32_t>(v)) == static_cast<std::int32_t>(v);
}

/// No area but for rounding.
bool degenerate(const Vec3& ab, const Vec3& ac, double area) {
  return area <= 1e-14 * std::max(ab.squaredNorm(), ac.squaredNorm());
}

/// Integrals over the surface and the enclosed volume, about the centre of the box for the sake of rounding.
void integrate(const TriangleMesh& mesh, MeshReport& report) {
  const Vec3 origin = report.box.center();
  Vec3 surface_moment = Vec3::Zero();
  Vec3 volume_moment = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - origin;
    const Vec3 b = mesh.corner(t, 1) - origin;
    const Vec3 c = mesh.corner(t, 2) - origin;
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const double volume = a.dot(b.cross(c)) / 6.0;  // of the tetrahedron (origin, a, b, c)
    report.degenerate_triangles +=
        degenerate(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0), area);
    report.area += area;
    report.volume += volume;
    surface_moment += area / 3.0 * (a + b + c);
    volume_moment += volume / 4.0 * (a + b + c);
  }
  if (std::abs(report.volume) <= 1e-12 * report.area * report.box.diagonal()) report.volume = 0.0;
  report.surface_center = origin;
  if (report.area > 0.0) report.surface_center += surface_moment / report.area;
  if (report.volume != 0.0) report.volume_center = origin + volume_moment / report.volume;
}

}  // namespace

MeshReport inspect_mesh(const TriangleMesh& mesh) {
  MeshReport report;
  if (mesh.empty()) return report;
  TriangleMesh welded = mesh;
  weld(welded, 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) report.box.add(mesh.corner(t, k));
  inspect_topology(welded, report);
  integrate(mesh, report);
  return report;
}

void require_sound_mesh(const TriangleMesh& mesh, const std::string& what) {
  if (mesh.empty()) fail("{}: has no triangles, expected a surface; export faces as well", what);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite())
      fail("{}: vertex {} is not finite, expected three numbers; export the mesh again", what, v);
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::int32_t v : mesh.triangles[t])
      if (v < 0 || v >= count)
        fail(
            "{}: triangle {} uses vertex {}, but there are only {} vertices (0 to {}); export the mesh again",
            what, t, v, count, count - 1);
}

}  // namespace eigengrasp
