// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "geometry/point_tree.hpp"

#include <algorithm>
#include <numeric>

namespace eigengrasp {

PointTree::PointTree(const std::vector<Vec3>& points) : order_(points.size()) {
  if (points.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.push_back({{}, 0, static_cast<int>(points.size()), 0});
  for (std::size_t node = 0; node < nodes_.size(); ++node) build(node, points);
  points_.reserve(points.size());
  for (int i : order_) points_.push_back(points[static_cast<std::size_t>(i)]);
}

void PointTree::build(std::size_t node, const std::vector<Vec3>& points) {
  constexpr int leaf_size = 16;
  const auto begin = order_.begin() + nodes_[node].first;
  const int count = nodes_[node].count;
  Box box;
  for (auto i = begin; i != begin + count; ++i) box.add(points[static_cast<std::size_t>(*i)]);
  nodes_[node].box = box;
  if (count <= leaf_size) return;
  Eigen::Index axis = 0;
  box.size().maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](int i, int j) {
    const double a = points[static_cast<std::size_t>(i)][axis];
    const double b = points[static_cast<std::size_t>(j)][axis];
    return a != b ? a < b : i < j;
  });
  const int first = nodes_[node].first;
  nodes_[node].left = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, first, half, 0});
  nodes_.push_back({{}, first + half, count - half, 0});
}

void PointTree::find_in(const Sphere& ball, std::vector<int>& places) const {
  places.clear();
  if (nodes_.empty()) return;
  const double reach2 = ball.radius * ball.radius;
  const Vec3& c = ball.center;
  int stack[64];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--top])];
    const Vec3 outside = (node.box.min - c).cwiseMax(c - node.box.max).cwiseMax(Vec3::Zero());
    if (outside.squaredNorm() > reach2) continue;
    if (node.left > 0) {
      stack[top++] = node.left;
      stack[top++] = node.left + 1;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i)
      if ((point(i) - c).squaredNorm() <= reach2) places.push_back(i);
  }
}

}  // namespace eigengrasp
