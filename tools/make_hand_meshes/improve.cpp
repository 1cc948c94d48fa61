// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <map>

#include "polygonise.hpp"

namespace eigengrasp::shapes {
namespace {

using Triangle = TriangleMesh::Triangle;

std::size_t index(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Makes the triangles of a closed mesh rounder and lays their edges along the surface, by turns of edges and
/// small moves of vertices on the surface. Neither changes the number of triangles.
class Improver {
 public:
  Improver(TriangleMesh& mesh, const Solid& solid) : solid_(solid), mesh_(mesh) {
    for (const Vec3& p : mesh.vertices) normals_.push_back(outward_normal(solid, p));
  }

  void flip_edges() {
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> owner;  // halfedge -> triangle
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) owner[halfedge(t, k)] = t;
    }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (flip(owner, t, k)) break;
      }
    }
  }

  void move_vertices() {
    std::vector<std::vector<std::size_t>> around(mesh_.vertices.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::int32_t v : mesh_.triangles[t]) around[index(v)].push_back(t);
    }
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) move_vertex(v, around[v]);
  }

 private:
  std::pair<std::int32_t, std::int32_t> halfedge(std::size_t t, std::size_t k) const {
    return {mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]};
  }

  /// High where the triangle is round and stands square to the surface normals of its corners.
  double score(const Triangle& t) const {
    const Vec3& a = mesh_.vertices[index(t[0])];
    const Vec3& b = mesh_.vertices[index(t[1])];
    const Vec3& c = mesh_.vertices[index(t[2])];
    const Vec3 n = (b - a).cross(c - a);
    const double area2 = n.norm();
    if (area2 < 1e-16) return -2.0;
    double alignment = 1.0;
    for (const std::int32_t v : t) alignment = std::min(alignment, n.dot(normals_[index(v)]) / area2);
    const double side = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return alignment + 0.5 * area2 / side;
  }

  template <typename Owner>
  bool flip(Owner& owner, std::size_t t, std::size_t k) {
    const auto [a, b] = halfedge(t, k);
    const std::int32_t c = mesh_.triangles[t][(k + 2) % 3];
    const std::size_t u = owner.at({b, a});
    const Triangle& other = mesh_.triangles[u];
    const std::int32_t d = other[0] + other[1] + other[2] - a - b;
    if (c == d || owner.contains({c, d}) || owner.contains({d, c})) return false;
    const Triangle first{c, a, d};
    const Triangle second{d, b, c};
    const double before = std::min(score(mesh_.triangles[t]), score(other));
    if (std::min(score(first), score(second)) <= before + 1e-6) return false;
    mesh_.triangles[t] = first;
    mesh_.triangles[u] = second;
    owner.erase({a, b});
    owner.erase({b, a});
    for (const std::size_t changed : {t, u}) {
      for (std::size_t i = 0; i < 3; ++i) owner[halfedge(changed, i)] = changed;
    }
    return true;
  }

  double worst_score(const std::vector<std::size_t>& triangles) const {
    double worst = 2.0;
    for (const std::size_t t : triangles) worst = std::min(worst, score(mesh_.triangles[t]));
    return worst;
  }

  void move_vertex(std::size_t v, const std::vector<std::size_t>& around) {
    Vec3 center = Vec3::Zero();
    double weight = 0.0;
    for (const std::size_t t : around) {
      const double area = area_normal_of(t).norm();
      center += area * (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3;
      weight += area;
    }
    const Vec3 old_point = mesh_.vertices[v];
    const Vec3 old_normal = normals_[v];
    const double before = worst_score(around);
    Vec3 step = 0.6 * (center / weight - old_point);
    step -= step.dot(old_normal) * old_normal;
    mesh_.vertices[v] = project_to_surface(solid_, old_point + step);
    normals_[v] = outward_normal(solid_, mesh_.vertices[v]);
    if (worst_score(around) < before) {
      mesh_.vertices[v] = old_point;
      normals_[v] = old_normal;
    }
  }

  Vec3 area_normal_of(std::size_t t) const {
    return (mesh_.corner(t, 1) - mesh_.corner(t, 0)).cross(mesh_.corner(t, 2) - mesh_.corner(t, 0));
  }

  const Solid& solid_;
  TriangleMesh& mesh_;
  std::vector<Vec3> normals_;
};

}  // namespace

void improve(TriangleMesh& mesh, const Solid& solid, int rounds) {
  Improver improver(mesh, solid);
  for (int i = 0; i < rounds; ++i) {
    improver.flip_edges();
    improver.move_vertices();
  }
  improver.flip_edges();
}

}  // namespace eigengrasp::shapes
