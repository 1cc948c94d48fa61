// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "polygonise.hpp"

#include <fmt/format.h>

#include <map>
#include <unordered_map>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp::shapes {
namespace {

/// The cube in six tetrahedra around its diagonal 0-7; corner number = x + 2 y + 4 z.
constexpr std::array<std::array<int, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

class Grid {
 public:
  Grid(const Solid& solid, double cell) : solid_(solid), cell_(cell) {
    // Off the planes of symmetry of the shapes, so that no corner lies exactly on a face.
    origin_ = solid.bounds.min - Vec3(2.37, 2.41, 2.43) * cell;
    for (int i = 0; i < 3; ++i) {
      size_[static_cast<std::size_t>(i)] =
          static_cast<std::int64_t>((solid.bounds.max[i] - origin_[i]) / cell) + 4;
    }
    values_.resize(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]));
    for (std::int64_t n = 0; n < static_cast<std::int64_t>(values_.size()); ++n) {
      const double d = solid.distance(point(n));
      values_[static_cast<std::size_t>(n)] = d == 0 ? 1e-12 : d;
    }
  }

  TriangleMesh surface() {
    for (std::int64_t z = 0; z + 1 < size_[2]; ++z) {
      for (std::int64_t y = 0; y + 1 < size_[1]; ++y) {
        for (std::int64_t x = 0; x + 1 < size_[0]; ++x) add_cube(x + size_[0] * (y + size_[1] * z));
      }
    }
    for (Vec3& p : mesh_.vertices) p = project_to_surface(solid_, p);
    return std::move(mesh_);
  }

 private:
  Vec3 point(std::int64_t n) const {
    const std::int64_t x = n % size_[0];
    const std::int64_t y = n / size_[0] % size_[1];
    const std::int64_t z = n / (size_[0] * size_[1]);
    return origin_ + cell_ * Vec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
  }

  double value(std::int64_t n) const { return values_[static_cast<std::size_t>(n)]; }

  void add_cube(std::int64_t n) {
    std::array<std::int64_t, 8> corner;
    int inside = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const auto i = static_cast<std::int64_t>(k);
      corner[k] = n + (i & 1) + size_[0] * ((i >> 1 & 1) + size_[1] * (i >> 2));
      inside += value(corner[k]) < 0 ? 1 : 0;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& t : tetrahedra) {
      add_tetrahedron({corner[static_cast<std::size_t>(t[0])], corner[static_cast<std::size_t>(t[1])],
                       corner[static_cast<std::size_t>(t[2])], corner[static_cast<std::size_t>(t[3])]});
    }
  }

  void add_tetrahedron(const std::array<std::int64_t, 4>& t) {
    std::vector<std::int64_t> in;
    std::vector<std::int64_t> out;
    for (const std::int64_t n : t) (value(n) < 0 ? in : out).push_back(n);
    if (in.empty() || out.empty()) return;
    const Vec3 outwards = center(out) - center(in);
    if (in.size() == 1) {
      add_triangle(edge(in[0], out[0]), edge(in[0], out[1]), edge(in[0], out[2]), outwards);
    } else if (out.size() == 1) {
      add_triangle(edge(in[0], out[0]), edge(in[1], out[0]), edge(in[2], out[0]), outwards);
    } else {
      const std::int32_t a = edge(in[0], out[0]);
      const std::int32_t c = edge(in[1], out[1]);
      add_triangle(a, edge(in[0], out[1]), c, outwards);
      add_triangle(a, c, edge(in[1], out[0]), outwards);
    }
  }

  Vec3 center(const std::vector<std::int64_t>& corners) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int64_t n : corners) sum += point(n);
    return sum / static_cast<double>(corners.size());
  }

  std::int32_t edge(std::int64_t a, std::int64_t b) {
    const auto key = std::minmax(a, b);
    const auto [it, added] =
        vertex_of_edge_.try_emplace(key, static_cast<std::int32_t>(mesh_.vertices.size()));
    if (added) {
      const double t = std::clamp(value(a) / (value(a) - value(b)), 0.02, 0.98);
      mesh_.vertices.push_back((1 - t) * point(a) + t * point(b));
    }
    return it->second;
  }

  void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c, const Vec3& outwards) {
    const auto at = [&](std::int32_t i) -> const Vec3& {
      return mesh_.vertices[static_cast<std::size_t>(i)];
    };
    const bool flipped = (at(b) - at(a)).cross(at(c) - at(a)).dot(outwards) < 0;
    mesh_.triangles.push_back(flipped ? TriangleMesh::Triangle{a, c, b} : TriangleMesh::Triangle{a, b, c});
  }

  const Solid& solid_;
  double cell_;
  Vec3 origin_;
  std::array<std::int64_t, 3> size_;
  std::vector<double> values_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> vertex_of_edge_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh polygonise(const Solid& solid, double cell) {
  return Grid(solid, cell).surface();
}

void require_closed_manifold(const TriangleMesh& mesh, const std::string& name) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> halfedges;
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++halfedges[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}];
    }
    volume += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2))) / 6;
  }
  for (const auto& [edge, count] : halfedges) {
    if (count != 1 || !halfedges.contains({edge.second, edge.first})) {
      fail("mesh {}: the surface is not a closed manifold at edge {}-{}; use a finer cell", name, edge.first,
           edge.second);
    }
  }
  if (volume <= 0) fail("mesh {}: the shape is empty or inside out (volume {} m^3)", name, volume);
}

}  // namespace eigengrasp::shapes
