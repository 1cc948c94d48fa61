// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <Eigen/LU>
#include <algorithm>
#include <queue>
#include <set>

#include "polygonise.hpp"

namespace eigengrasp::shapes {
namespace {

using Mat4 = Eigen::Matrix4d;
using Triangle = TriangleMesh::Triangle;

std::size_t index(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

struct Collapse {
  double cost;
  std::int32_t a, b;
  int stamp;
  Vec3 target;
  bool operator<(const Collapse& o) const {  // std::priority_queue: largest first
    return std::tie(o.cost, o.a, o.b) < std::tie(cost, a, b);
  }
};

class Decimator {
 public:
  Decimator(const TriangleMesh& mesh, const Solid& solid)
      : solid_(solid),
        vertices_(mesh.vertices),
        triangles_(mesh.triangles),
        alive_(mesh.triangles.size(), true) {
    around_.resize(vertices_.size());
    quadrics_.assign(vertices_.size(), Mat4::Zero());
    stamps_.assign(vertices_.size(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (const std::int32_t v : triangles_[t]) around_[index(v)].push_back(t);
      add_quadric(t);
    }
    for (const Vec3& p : vertices_) normals_.push_back(outward_normal(solid, p));
  }

  void run(std::size_t max_triangles) {
    std::size_t before = triangles_.size() + 1;
    std::size_t count = triangles_.size();
    // An edge that could not go may be able to once its surroundings have changed: hence several passes.
    while (count > max_triangles && count < before) {
      before = count;
      fill_queue();
      while (count > max_triangles && !queue_.empty()) {
        Collapse c = queue_.top();
        queue_.pop();
        if (c.stamp == stamp(c.a, c.b) && try_collapse(c)) count -= 2;
      }
    }
  }

  TriangleMesh result() const {
    TriangleMesh out;
    std::vector<std::int32_t> number(vertices_.size(), -1);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!alive_[t]) continue;
      Triangle copy = triangles_[t];
      for (std::int32_t& v : copy) {
        std::int32_t& n = number[index(v)];
        if (n < 0) {
          n = static_cast<std::int32_t>(out.vertices.size());
          out.vertices.push_back(vertices_[index(v)]);
        }
        v = n;
      }
      out.triangles.push_back(copy);
    }
    return out;
  }

 private:
  Vec3 area_normal_of(const Triangle& t) const {
    const Vec3& a = vertices_[index(t[0])];
    return (vertices_[index(t[1])] - a).cross(vertices_[index(t[2])] - a);
  }

  void add_quadric(std::size_t t) {
    const Vec3 n = area_normal_of(triangles_[t]);
    const double area2 = n.norm();
    if (area2 <= 0) return;
    Eigen::Vector4d plane;
    plane << n / area2, -n.dot(vertices_[index(triangles_[t][0])]) / area2;
    for (const std::int32_t v : triangles_[t]) quadrics_[index(v)] += 0.5 * area2 * plane * plane.transpose();
  }

  /// Grows whenever one of the two vertices changes; -1 where one of them is gone.
  int stamp(std::int32_t a, std::int32_t b) const {
    if (around_[index(a)].empty() || around_[index(b)].empty()) return -1;
    return stamps_[index(a)] + stamps_[index(b)];
  }

  void fill_queue() {
    queue_ = {};
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t k = 0; alive_[t] && k < 3; ++k) {
        const std::int32_t a = triangles_[t][k];
        const std::int32_t b = triangles_[t][(k + 1) % 3];
        if (a < b) push(a, b);
      }
    }
  }

  bool try_collapse(Collapse& c) {
    const double reach = 2.0 * (vertices_[index(c.a)] - vertices_[index(c.b)]).norm();
    const Vec3 middle = 0.5 * (vertices_[index(c.a)] + vertices_[index(c.b)]);
    if ((c.target - middle).norm() > reach) c.target = middle;
    c.target = project_to_surface(solid_, c.target);
    const Vec3 normal = outward_normal(solid_, c.target);
    if (!allowed(c, normal)) return false;
    apply(c, normal);
    return true;
  }

  std::set<std::int32_t> neighbours(std::int32_t v) const {
    std::set<std::int32_t> found;
    for (const std::size_t t : around_[index(v)]) found.insert(triangles_[t].begin(), triangles_[t].end());
    found.erase(v);
    return found;
  }

  void push(std::int32_t a, std::int32_t b) {
    const Mat4 Q = quadrics_[index(a)] + quadrics_[index(b)];
    const Vec3& pa = vertices_[index(a)];
    const Vec3& pb = vertices_[index(b)];
    const Vec3 middle = 0.5 * (pa + pb);
    const double weight = 1e-2 * Q.topLeftCorner<3, 3>().trace() + 1e-12;
    const Mat3 A = Q.topLeftCorner<3, 3>() + weight * Mat3::Identity();
    const Vec3 target = A.inverse() * (weight * middle - Q.topRightCorner<3, 1>());
    const Eigen::Vector4d h = target.homogeneous();
    // The length term keeps triangles of flat regions even.
    const double cost = h.dot(Q * h) + 0.1 * weight * (pa - pb).squaredNorm();
    queue_.push({cost, std::min(a, b), std::max(a, b), stamp(a, b), target});
  }

  /// The two ends share exactly two neighbours and no triangle turns over or becomes a needle.
  bool allowed(const Collapse& c, const Vec3& normal) const {
    const std::set<std::int32_t> na = neighbours(c.a);
    const std::set<std::int32_t> nb = neighbours(c.b);
    std::vector<std::int32_t> shared;
    std::set_intersection(na.begin(), na.end(), nb.begin(), nb.end(), std::back_inserter(shared));
    if (shared.size() != 2 || na.size() + nb.size() < 8) return false;
    return keeps_shape(c.a, c.b, c.target, normal) && keeps_shape(c.b, c.a, c.target, normal);
  }

  bool keeps_shape(std::int32_t moving, std::int32_t other, const Vec3& target, const Vec3& normal) const {
    for (const std::size_t t : around_[index(moving)]) {
      const Triangle& tri = triangles_[t];
      if (std::find(tri.begin(), tri.end(), other) != tri.end()) continue;
      std::array<Vec3, 3> before;
      std::array<Vec3, 3> after;
      Vec3 outwards = normal;
      for (std::size_t k = 0; k < 3; ++k) {
        before[k] = vertices_[index(tri[k])];
        after[k] = tri[k] == moving ? target : before[k];
        if (tri[k] != moving) outwards += normals_[index(tri[k])];
      }
      if (alignment(after, outwards) < std::min(0.5, alignment(before, outwards))) return false;
      if (roundness(after) < std::min(0.04, roundness(before))) return false;
    }
    return true;
  }

  /// Cosine of the angle between the normal of a triangle and a direction.
  static double alignment(const std::array<Vec3, 3>& p, const Vec3& direction) {
    const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
    return n.dot(direction) / (n.norm() * direction.norm() + 1e-30);
  }

  /// Twice the area over the square of the longest side: 0.87 for an equilateral triangle, 0 for a needle.
  static double roundness(const std::array<Vec3, 3>& p) {
    const double side =
        std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    return side > 0 ? (p[1] - p[0]).cross(p[2] - p[0]).norm() / side : 0.0;
  }

  void apply(const Collapse& c, const Vec3& normal) {
    vertices_[index(c.a)] = c.target;
    normals_[index(c.a)] = normal;
    quadrics_[index(c.a)] += quadrics_[index(c.b)];
    for (const std::size_t t : around_[index(c.b)]) {
      Triangle& tri = triangles_[t];
      if (std::find(tri.begin(), tri.end(), c.a) != tri.end()) {
        alive_[t] = false;
        for (const std::int32_t v : tri) {
          if (v != c.b) std::erase(around_[index(v)], t);
        }
      } else {
        std::replace(tri.begin(), tri.end(), c.b, c.a);
        around_[index(c.a)].push_back(t);
      }
    }
    around_[index(c.b)].clear();
    stamps_[index(c.a)] += 1;
    stamps_[index(c.b)] += 1;
    for (const std::int32_t v : neighbours(c.a)) push(c.a, v);
  }

  const Solid& solid_;
  std::vector<Vec3> vertices_;
  std::vector<Vec3> normals_;
  std::vector<Triangle> triangles_;
  std::vector<bool> alive_;
  std::vector<std::vector<std::size_t>> around_;
  std::vector<Mat4> quadrics_;
  std::vector<int> stamps_;
  std::priority_queue<Collapse> queue_;
};

}  // namespace

TriangleMesh decimate(const TriangleMesh& mesh, const Solid& solid, std::size_t max_triangles) {
  Decimator decimator(mesh, solid);
  decimator.run(max_triangles);
  return decimator.result();
}

}  // namespace eigengrasp::shapes
