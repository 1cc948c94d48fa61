// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/modeling/decimate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "eigengrasp/modeling/mesh_tools.hpp"

namespace eigengrasp::modeling {
namespace {

using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Sum of weighted squared distances to planes (and points): p'Ap + 2b'p + c.
struct Quadric {
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0.0;
  double weight = 0.0;

  void add_plane(const Vec3& n, const Vec3& p, double w) {
    const double d = -n.dot(p);
    A += w * n * n.transpose();
    b += w * d * n;
    c += w * d * d;
    weight += w;
  }
  void add_point(const Vec3& p, double w) {
    A += w * Mat3::Identity();
    b -= w * p;
    c += w * p.squaredNorm();
  }
  Quadric& operator+=(const Quadric& q) {
    A += q.A;
    b += q.b;
    c += q.c;
    weight += q.weight;
    return *this;
  }
  double operator()(const Vec3& p) const { return std::max(0.0, p.dot(A * p) + 2.0 * b.dot(p) + c); }
};

struct Collapse {
  double cost;
  Index a, b;
  std::uint32_t stamp_a, stamp_b;
  bool operator<(const Collapse& o) const {  // the cheapest on top; ties by index, so that the order is fixed
    if (cost != o.cost) return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

class Decimator {
 public:
  Decimator(TriangleMesh& mesh, const DecimateOptions& options)
      : mesh_(mesh),
        options_(options),
        fans_(mesh.vertices.size()),
        quadrics_(mesh.vertices.size()),
        stamps_(mesh.vertices.size(), 0),
        alive_(mesh.triangles.size(), true),
        n_alive_(mesh.triangles.size()) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const Index v : mesh.triangles[t]) fans_[at(v)].push_back(static_cast<Index>(t));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) add_quadric(t);
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] < t[(k + 1) % 3]) push(t[k], t[(k + 1) % 3]);
      }
    }
  }

  void run() {
    while (n_alive_ > options_.target_triangles && !queue_.empty()) {
      const Collapse next = queue_.top();
      queue_.pop();
      if (stamps_[at(next.a)] != next.stamp_a || stamps_[at(next.b)] != next.stamp_b) continue;
      const Vec3 p = best_point(next.a, next.b);
      if (allowed(next.a, next.b, p)) merge(next.a, next.b, p);
    }
    compact();
  }

 private:
  void add_quadric(std::size_t t) {
    const Vec3 n = area_normal(mesh_, t);
    const double area = 0.5 * n.norm();
    if (area <= 0.0) return;
    const Vec3 center = (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3.0;
    for (const Index v : mesh_.triangles[t]) {
      quadrics_[at(v)].add_plane(n / (2.0 * area), center, area / 3.0);
      quadrics_[at(v)].add_point(mesh_.vertices[at(v)], options_.shape_weight * area / 3.0);
    }
  }

  Vec3 best_point(Index a, Index b) const {
    Quadric q = quadrics_[at(a)];
    q += quadrics_[at(b)];
    const Vec3 middle = 0.5 * (mesh_.vertices[at(a)] + mesh_.vertices[at(b)]);
    const double length = (mesh_.vertices[at(a)] - mesh_.vertices[at(b)]).norm();
    // A little pull to the middle keeps the system well posed where the surface is flat.
    q.add_point(middle, 1e-3 * q.weight);
    const Vec3 p = q.A.ldlt().solve(-q.b);
    return p.allFinite() && (p - middle).norm() < 1.5 * length ? p : middle;
  }

  void push(Index a, Index b) {
    if (a > b) std::swap(a, b);
    Quadric q = quadrics_[at(a)];
    q += quadrics_[at(b)];
    const double error2 = q(best_point(a, b));
    // weight is three times the area around: the mean squared distance to its planes.
    if (std::sqrt(error2 / std::max(q.weight, 1e-300)) > options_.max_error) return;
    queue_.push({error2, a, b, stamps_[at(a)], stamps_[at(b)]});
  }

  std::vector<Index> neighbours(Index v) const {
    std::vector<Index> ring;
    for (const Index t : fans_[at(v)]) {
      for (const Index w : mesh_.triangles[at(t)]) {
        if (w != v) ring.push_back(w);
      }
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    return ring;
  }

  bool has(Index t, Index v) const {
    const auto& x = mesh_.triangles[at(t)];
    return x[0] == v || x[1] == v || x[2] == v;
  }

  /// Link condition: the ends share just the two corners across the edge; a tetrahedron is not collapsed.
  bool link_ok(Index a, Index b) const {
    const std::vector<Index> ring_a = neighbours(a), ring_b = neighbours(b);
    std::vector<Index> both;
    std::set_intersection(ring_a.begin(), ring_a.end(), ring_b.begin(), ring_b.end(),
                          std::back_inserter(both));
    if (both.size() != 2) return false;
    for (const Index v : both) {
      if (fans_[at(v)].size() <= 3) return false;
    }
    return ring_a.size() + ring_b.size() - 2 > 4;
  }

  /// Would the triangles around v, without those that hold `other`, stay sound with v at p?
  bool fan_ok(Index v, Index other, const Vec3& p) const {
    for (const Index t : fans_[at(v)]) {
      if (has(t, other)) continue;
      std::array<Vec3, 3> now, then;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index w = mesh_.triangles[at(t)][k];
        now[k] = mesh_.vertices[at(w)];
        then[k] = w == v ? p : now[k];
        if (w != v && (now[k] - p).norm() > options_.max_edge) return false;
      }
      const double before = triangle_quality(now[0], now[1], now[2]),
                   after = triangle_quality(then[0], then[1], then[2]);
      if (after < std::min(options_.min_quality, before) || after < 1e-3) return false;
      const Vec3 n0 = (now[1] - now[0]).cross(now[2] - now[0]),
                 n1 = (then[1] - then[0]).cross(then[2] - then[0]);
      // The normal of a sliver says little.
      const double least = before < 0.05 ? 0.0 : options_.min_normal_cosine;
      if (n0.dot(n1) <= least * n0.norm() * n1.norm()) return false;
    }
    return true;
  }

  bool allowed(Index a, Index b, const Vec3& p) const {
    return link_ok(a, b) && fan_ok(a, b, p) && fan_ok(b, a, p);
  }

  void merge(Index a, Index b, const Vec3& p) {
    mesh_.vertices[at(a)] = p;
    quadrics_[at(a)] += quadrics_[at(b)];
    for (const Index t : fans_[at(b)]) {
      if (has(t, a)) {
        alive_[at(t)] = false;
        --n_alive_;
        for (const Index w : mesh_.triangles[at(t)]) {
          if (w != b) std::erase(fans_[at(w)], t);
        }
      } else {
        for (Index& w : mesh_.triangles[at(t)]) w = w == b ? a : w;
        fans_[at(a)].push_back(t);
      }
    }
    fans_[at(b)].clear();
    ++stamps_[at(b)];
    ++stamps_[at(a)];
    for (const Index w : neighbours(a)) push(a, w);
  }

  void compact() {
    std::vector<Index> name(mesh_.vertices.size(), -1);
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Triangle> triangles;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!alive_[t]) continue;
      auto triangle = mesh_.triangles[t];
      for (Index& v : triangle) {
        if (name[at(v)] < 0) {
          name[at(v)] = static_cast<Index>(vertices.size());
          vertices.push_back(mesh_.vertices[at(v)]);
        }
        v = name[at(v)];
      }
      triangles.push_back(triangle);
    }
    mesh_.vertices = std::move(vertices);
    mesh_.triangles = std::move(triangles);
  }

  TriangleMesh& mesh_;
  const DecimateOptions& options_;
  std::vector<std::vector<Index>> fans_;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> stamps_;
  std::vector<bool> alive_;
  std::size_t n_alive_;
  std::priority_queue<Collapse> queue_;
};

}  // namespace

void decimate(TriangleMesh& mesh, const DecimateOptions& options) {
  Decimator(mesh, options).run();
}

}  // namespace eigengrasp::modeling
