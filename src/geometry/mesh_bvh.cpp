// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/mesh_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace eigengrasp {

namespace {

constexpr int leaf_size = 4;
constexpr int stack_size = 128;  // median splits: depth is below log2 of the triangle count + 1

Box box_of(const TriangleCorners& t) {
  Box box;
  box.add(t.a);
  box.add(t.b);
  box.add(t.c);
  return box;
}

inline double squared_distance(const Box& box, const Vec3& p) {
  const Vec3 outside = (box.min - p).cwiseMax(p - box.max).cwiseMax(Vec3::Zero());
  return outside.squaredNorm();
}

/// Solid angle of a triangle seen from p, signed (Van Oosterom and Strackee 1983).
double solid_angle(const TriangleCorners& t, const Vec3& p) {
  const Vec3 a = t.a - p;
  const Vec3 b = t.b - p;
  const Vec3 c = t.c - p;
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double numerator = a.dot(b.cross(c));
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2.0 * std::atan2(numerator, denominator);
}

}  // namespace

MeshBvh::MeshBvh(const TriangleMesh& mesh) {
  if (mesh.empty()) return;
  const std::size_t n = mesh.triangles.size();
  corners_.reserve(n);
  std::vector<Vec3> centers(n);
  for (std::size_t t = 0; t < n; ++t) {
    corners_.push_back({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
    centers[t] = box_of(corners_[t]).center();
  }
  order_.resize(n);
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(n);
  nodes_.emplace_back();
  build(0, 0, static_cast<int>(n), centers);
  box_ = nodes_[0].box;
  compute_dipoles();
  compute_oriented_boxes();
}

void MeshBvh::build(int node, int first, int count, const std::vector<Vec3>& centers) {
  Box box;
  Box center_box;
  for (int i = first; i < first + count; ++i) {
    const auto t = static_cast<std::size_t>(triangle_at(i));
    box.add(box_of(corners_[t]));
    center_box.add(centers[t]);
  }
  const auto index = static_cast<std::size_t>(node);
  nodes_[index].box = box;
  if (count <= leaf_size) {
    nodes_[index].left = first;
    nodes_[index].count = count;
    return;
  }
  Eigen::Index axis = 0;
  center_box.size().maxCoeff(&axis);
  const int half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](int i, int j) {
    const double a = centers[static_cast<std::size_t>(i)][axis];
    const double b = centers[static_cast<std::size_t>(j)][axis];
    return a != b ? a < b : i < j;
  });
  const int left = static_cast<int>(nodes_.size());
  nodes_[index].left = left;
  nodes_.resize(nodes_.size() + 2);
  build(left, first, half, centers);
  build(left + 1, first + half, count - half, centers);
}

void MeshBvh::compute_dipoles() {
  std::vector<double> areas(nodes_.size(), 0.0);
  dipoles_.resize(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // children stand behind their parent
    const Node& node = nodes_[i];
    Dipole& d = dipoles_[i];
    const auto add = [&](const Vec3& center, const Vec3& moment, double area) {
      d.center += area * center;
      d.moment += moment;
      areas[i] += area;
    };
    if (node.count > 0) {
      for (int k = node.left; k < node.left + node.count; ++k) {
        const TriangleCorners& t = corners(triangle_at(k));
        const Vec3 area_vector = 0.5 * (t.b - t.a).cross(t.c - t.a);
        add((t.a + t.b + t.c) / 3.0, area_vector, area_vector.norm());
      }
    } else {
      for (int child : {node.left, node.left + 1}) {
        const auto c = static_cast<std::size_t>(child);
        add(dipoles_[c].center, dipoles_[c].moment, areas[c]);
      }
    }
    d.center = areas[i] > 0.0 ? Vec3(d.center / areas[i]) : node.box.center();
    d.radius = (d.center - node.box.min).cwiseAbs().cwiseMax((node.box.max - d.center).cwiseAbs()).norm();
  }
}

ClosestPoint MeshBvh::closest_point(const Vec3& p, double max_distance) const {
  ClosestPoint best;
  best.distance = max_distance;
  if (empty()) return best;
  double best2 = max_distance * max_distance;
  struct Entry {
    int node;
    double distance2;
  };
  Entry stack[stack_size];
  int top = 0;
  stack[top++] = {0, squared_distance(box_, p)};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.distance2 >= best2) continue;
    const Node& node = nodes_[static_cast<std::size_t>(entry.node)];
    if (node.count == 0) {
      Entry near{node.left, squared_distance(nodes_[static_cast<std::size_t>(node.left)].box, p)};
      Entry far{node.left + 1, squared_distance(nodes_[static_cast<std::size_t>(node.left) + 1].box, p)};
      if (far.distance2 < near.distance2) std::swap(near, far);
      if (far.distance2 < best2) stack[top++] = far;
      if (near.distance2 < best2) stack[top++] = near;
      continue;
    }
    for (int i = node.left; i < node.left + node.count; ++i) {
      const int t = triangle_at(i);
      const Vec3 q = closest_point_on_triangle(corners(t), p);
      const double d2 = (q - p).squaredNorm();
      if (d2 < best2) {
        best2 = d2;
        best.point = q;
        best.triangle = t;
      }
    }
  }
  best.distance = std::sqrt(best2);
  return best;
}

double MeshBvh::winding_number(const Vec3& p) const {
  if (empty()) return 0.0;
  constexpr double far_factor = 2.0;  // accuracy parameter beta of Barill et al.
  double sum = 0.0;
  int stack[stack_size];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const auto index = static_cast<std::size_t>(stack[--top]);
    const Node& node = nodes_[index];
    const Dipole& dipole = dipoles_[index];
    const Vec3 d = dipole.center - p;
    const double distance = d.norm();
    if (distance > far_factor * dipole.radius) {
      sum += d.dot(dipole.moment) / (distance * distance * distance);
    } else if (node.count > 0) {
      for (int i = node.left; i < node.left + node.count; ++i) sum += solid_angle(corners(triangle_at(i)), p);
    } else {
      stack[top++] = node.left;
      stack[top++] = node.left + 1;
    }
  }
  return sum / (4.0 * std::numbers::pi);
}

double MeshBvh::signed_distance(const Vec3& p) const {
  const double distance = closest_point(p).distance;
  return contains(p) ? -distance : distance;
}

}  // namespace eigengrasp
