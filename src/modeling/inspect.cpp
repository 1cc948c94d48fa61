// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "eigengrasp/modeling/mesh_tools.hpp"

namespace eigengrasp::modeling {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t v) {
  while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
  return v;
}

/// Directed edges (from, to) of all triangles, sorted.
std::vector<std::pair<std::int32_t, std::int32_t>> directed_edges(const TriangleMesh& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

bool is_closed(const std::vector<std::pair<std::int32_t, std::int32_t>>& edges) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i] == edges[i - 1]) return false;
    if (edges[i].first == edges[i].second) return false;
    const std::pair back{edges[i].second, edges[i].first};
    if (!std::binary_search(edges.begin(), edges.end(), back)) return false;
  }
  return !edges.empty();
}

/// Each vertex has one cycle of opposite edges.
bool has_single_fans(const TriangleMesh& mesh) {
  std::vector<std::map<std::int32_t, std::int32_t>> next(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) next[at(t[k])][t[(k + 1) % 3]] = t[(k + 2) % 3];
  }
  for (const auto& ring : next) {
    if (ring.empty()) return false;  // a vertex that no triangle uses
    std::size_t steps = 0;
    std::int32_t v = ring.begin()->first;
    do {
      const auto it = ring.find(v);
      if (it == ring.end() || ++steps > ring.size()) return false;
      v = it->second;
    } while (v != ring.begin()->first);
    if (steps != ring.size()) return false;
  }
  return true;
}

int count_components(const TriangleMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 1; k < 3; ++k) parent[at(root_of(parent, t[k]))] = root_of(parent, t[0]);
  }
  int roots = 0;
  for (std::size_t v = 0; v < parent.size(); ++v) roots += at(parent[v]) == v;
  return roots;
}

bool segment_cuts(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double dp = n.dot(p - t[0]), dq = n.dot(q - t[0]);
  if (dp * dq >= 0.0) return false;
  const Vec3 x = p + (q - p) * (dp / (dp - dq));
  for (std::size_t k = 0; k < 3; ++k) {
    if (n.dot((t[(k + 1) % 3] - t[k]).cross(x - t[k])) <= 0.0) return false;
  }
  return true;
}

bool triangles_cut(const TriangleMesh& mesh, std::int32_t i, std::int32_t j) {
  const auto &a = mesh.triangles[at(i)], &b = mesh.triangles[at(j)];
  std::array<Vec3, 3> p, q;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = mesh.vertices[at(a[k])];
    q[k] = mesh.vertices[at(b[k])];
  }
  const auto among = [](std::int32_t v, const TriangleMesh::Triangle& t) {
    return v == t[0] || v == t[1] || v == t[2];
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    if (!among(a[k], b) && !among(a[l], b) && segment_cuts(p[k], p[l], q)) return true;
    if (!among(b[k], a) && !among(b[l], a) && segment_cuts(q[k], q[l], p)) return true;
  }
  return false;
}

/// Sweep over the boxes sorted along x.
std::size_t count_intersections(const TriangleMesh& mesh, Vec3& first) {
  const std::size_t n = mesh.triangles.size();
  std::vector<Box> boxes(n);
  for (std::size_t t = 0; t < n; ++t) {
    for (int k = 0; k < 3; ++k) boxes[t].add(mesh.corner(t, k));
  }
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return boxes[at(a)].min.x() < boxes[at(b)].min.x(); });
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Box& a = boxes[at(order[i])];
    for (std::size_t j = i + 1; j < n && boxes[at(order[j])].min.x() <= a.max.x(); ++j) {
      const Box& b = boxes[at(order[j])];
      if (a.min.y() > b.max.y() || b.min.y() > a.max.y() || a.min.z() > b.max.z() || b.min.z() > a.max.z())
        continue;
      if (!triangles_cut(mesh, order[i], order[j])) continue;
      if (count++ == 0) first = a.center();
    }
  }
  return count;
}

void measure(const TriangleMesh& mesh, MeshReport& report) {
  report.min_area = report.min_quality = mesh.empty() ? 0.0 : 1e300;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    const double twice = area_normal(mesh, t).norm();
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    report.volume += a.dot(b.cross(c)) / 6.0;
    report.area += 0.5 * twice;
    report.min_area = std::min(report.min_area, 0.5 * twice);
    report.min_quality = std::min(report.min_quality, triangle_quality(a, b, c));
    report.longest_edge = std::max(report.longest_edge, std::sqrt(std::max({ab, bc, ca})));
  }
}

}  // namespace

double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return edges > 0.0 ? 2.0 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / edges : 0.0;
}

MeshReport inspect(const TriangleMesh& mesh) {
  MeshReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  const auto edges = directed_edges(mesh);
  report.closed = is_closed(edges);
  report.manifold_vertices = report.closed && has_single_fans(mesh);
  report.components = count_components(mesh);
  std::size_t n_edges = 0;
  for (const auto& [from, to] : edges) n_edges += from < to;
  report.euler_characteristic =
      static_cast<int>(report.vertices) - static_cast<int>(n_edges) + static_cast<int>(report.triangles);
  measure(mesh, report);
  report.intersections = count_intersections(mesh, report.first_cut);
  return report;
}

std::vector<std::string> problems(const MeshReport& report, int expected_euler_characteristic) {
  std::vector<std::string> found;
  if (!report.closed)
    found.push_back("the surface is not closed: an edge is not used once in either direction");
  if (report.closed && !report.manifold_vertices)
    found.push_back("a vertex joins two fans of triangles or none");
  if (report.components != 1) found.push_back(fmt::format("{} components instead of one", report.components));
  if (report.euler_characteristic != expected_euler_characteristic) {
    found.push_back(fmt::format("Euler characteristic {} instead of {}", report.euler_characteristic,
                                expected_euler_characteristic));
  }
  if (!(report.volume > 0.0)) found.push_back("the volume is not positive: the normals point inwards");
  if (!(report.min_area > 0.0)) found.push_back("a triangle has no area");
  if (report.intersections > 0) {
    found.push_back(fmt::format("{} pairs of triangles cut each other, one near ({:.4f}, {:.4f}, {:.4f})",
                                report.intersections, report.first_cut.x(), report.first_cut.y(),
                                report.first_cut.z()));
  }
  return found;
}

}  // namespace eigengrasp::modeling
