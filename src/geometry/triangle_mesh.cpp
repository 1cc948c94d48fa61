// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/triangle_mesh.hpp"

#include <bit>
#include <cmath>
#include <unordered_map>

namespace eigengrasp {

Vec3 area_normal(const TriangleMesh& mesh, std::size_t t) {
  const Vec3& a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
}

Box bounding_box(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3& v : mesh.vertices) box.add(v);
  return box;
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += 0.5 * area_normal(mesh, t).norm();
  return area;
}

void transform(TriangleMesh& mesh, const Pose& X, double scale) {
  for (Vec3& v : mesh.vertices) v = scale * (X * v);
}

void append(TriangleMesh& a, const TriangleMesh& b) {
  const auto offset = static_cast<std::int32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (const std::int64_t k : c)
      h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ULL + (h >> 29);
    return static_cast<std::size_t>(h);
  }
};

/// Finds earlier vertices within a tolerance through cells of that size.
class VertexMerger {
 public:
  explicit VertexMerger(double tolerance) : tolerance_(tolerance), inverse_(1.0 / tolerance) {}

  std::int32_t find_or_add(const Vec3& p, std::vector<Vec3>& vertices) {
    const Cell home = cell_of(p);
    const std::int64_t reach = tolerance_ > 0 ? 1 : 0;
    for (std::int64_t x = -reach; x <= reach; ++x)
      for (std::int64_t y = -reach; y <= reach; ++y)
        for (std::int64_t z = -reach; z <= reach; ++z) {
          const auto [first, last] = cells_.equal_range({home[0] + x, home[1] + y, home[2] + z});
          for (auto it = first; it != last; ++it)
            if ((vertices[static_cast<std::size_t>(it->second)] - p).norm() <= tolerance_) return it->second;
        }
    const auto index = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(p);
    cells_.emplace(home, index);
    return index;
  }

 private:
  Cell cell_of(const Vec3& p) const {
    if (tolerance_ <= 0) {  // + 0.0 makes one zero of both
      return {std::bit_cast<std::int64_t>(p.x() + 0.0), std::bit_cast<std::int64_t>(p.y() + 0.0),
              std::bit_cast<std::int64_t>(p.z() + 0.0)};
    }
    return {std::llround(p.x() * inverse_), std::llround(p.y() * inverse_), std::llround(p.z() * inverse_)};
  }
  double tolerance_;
  double inverse_;
  std::unordered_multimap<Cell, std::int32_t, CellHash> cells_;
};

}  // namespace

void weld(TriangleMesh& mesh, double tolerance) {
  VertexMerger merger(tolerance);
  TriangleMesh welded;
  for (const auto& t : mesh.triangles) {
    TriangleMesh::Triangle w;
    for (std::size_t k = 0; k < 3; ++k)
      w[k] = merger.find_or_add(mesh.vertices[static_cast<std::size_t>(t[k])], welded.vertices);
    if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) welded.triangles.push_back(w);
  }
  mesh = std::move(welded);
}

}  // namespace eigengrasp
