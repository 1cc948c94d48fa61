// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp {

namespace {

/// Sums over a node's triangles from which the directions of its box follow.
struct Spread {
  double area = 0.0;
  Vec3 first = Vec3::Zero();   ///< integral of position
  Mat3 second = Mat3::Zero();  ///< integral of its outer product

  void add(const Spread& s) {
    area += s.area;
    first += s.first;
    second += s.second;
  }
  void add(const TriangleCorners& t, double least_area) {
    const double weight = std::max(0.5 * (t.b - t.a).cross(t.c - t.a).norm(), least_area);
    const Vec3 sum = t.a + t.b + t.c;
    area += weight;
    first += weight / 3.0 * sum;
    second += weight / 12.0 *
              (sum * sum.transpose() + t.a * t.a.transpose() + t.b * t.b.transpose() + t.c * t.c.transpose());
  }
  /// Principal directions as columns, a right-handed orthonormal basis.
  Mat3 directions() const {
    const Vec3 middle = first / area;
    Eigen::SelfAdjointEigenSolver<Mat3> solver(second / area - middle * middle.transpose());
    Mat3 axes = solver.eigenvectors();
    if (!axes.allFinite()) return Mat3::Identity();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
  }
};

}  // namespace

void MeshBvh::compute_oriented_boxes() {
  oriented_boxes_.resize(nodes_.size());
  std::vector<Spread> spreads(nodes_.size());
  std::vector<int> first(nodes_.size());  // of its triangles in leaf order, which are contiguous
  std::vector<int> count(nodes_.size());
  const double least_area = 1e-12 * box_.size().squaredNorm();  // gives degenerate triangles a weight
  const double size = box_.min.cwiseAbs().cwiseMax(box_.max.cwiseAbs()).maxCoeff();
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // children stand behind their parent
    const Node& node = nodes_[i];
    if (node.count > 0) {
      first[i] = node.left;
      count[i] = node.count;
      for (int k = node.left; k < node.left + node.count; ++k)
        spreads[i].add(corners(triangle_at(k)), least_area);
    } else {
      const auto left = static_cast<std::size_t>(node.left);
      first[i] = first[left];
      count[i] = count[left] + count[left + 1];
      spreads[i].add(spreads[left]);
      spreads[i].add(spreads[left + 1]);
    }
    const Mat3 axes = spreads[i].directions().cast<float>().cast<double>();
    Box local;
    for (int k = first[i]; k < first[i] + count[i]; ++k) {
      const TriangleCorners& t = corners(triangle_at(k));
      for (const Vec3* p : {&t.a, &t.b, &t.c}) local.add(axes.transpose() * *p);
    }
    OrientedBox& box = oriented_boxes_[i];
    // The axes are orthonormal but for rounding.
    const Vec3 center = axes.transpose().inverse() * local.center();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) box.rows[r][c] = static_cast<float>(axes(r, c));
      box.center[r] = static_cast<float>(center[r]);
      box.half[r] = static_cast<float>(0.5 * local.size()[r] * (1.0 + 1e-6) + 1e-6 * size);
    }
  }
}

}  // namespace eigengrasp
