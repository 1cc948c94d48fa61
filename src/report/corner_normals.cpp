// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "corner_normals.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace eigengrasp {

namespace {

/// For each vertex the number of its place.
std::vector<std::size_t> places_of(const TriangleMesh& mesh) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::map<Vec3, std::size_t, decltype(before)> places(before);
  std::vector<std::size_t> place(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    place[v] = places.emplace(mesh.vertices[v], places.size()).first->second;
  return place;
}

}  // namespace

std::vector<std::array<Vec3, 3>> corner_normals_of(const TriangleMesh& mesh, double crease_angle) {
  constexpr std::size_t kMostNeighbours = 512;
  const std::vector<std::size_t> place = places_of(mesh);
  std::vector<std::vector<std::size_t>> around(mesh.vertices.size());
  std::vector<Vec3> areas(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    areas[t] = area_normal(mesh, t);
    for (const auto v : mesh.triangles[t]) around[place[static_cast<std::size_t>(v)]].push_back(t);
  }
  const double least_cos = std::cos(crease_angle);
  std::vector<std::array<Vec3, 3>> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& neighbours = around[place[static_cast<std::size_t>(mesh.triangles[t][k])]];
      Vec3 sum = 1e-9 * areas[t];
      for (std::size_t i = 0; i < std::min(neighbours.size(), kMostNeighbours); ++i) {
        const Vec3& other = areas[neighbours[i]];
        if (areas[t].dot(other) >= least_cos * areas[t].norm() * other.norm()) sum += other;
      }
      normals[t][k] = sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3::UnitZ();
    }
  }
  return normals;
}

}  // namespace eigengrasp
