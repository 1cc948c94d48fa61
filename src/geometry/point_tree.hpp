// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/geometry/sphere_cover.hpp"

namespace eigengrasp {

/// Points, halved along the longest side again and again, to find those in a ball. Cost: about 0.1 us a point
/// to build.
class PointTree {
 public:
  explicit PointTree(const std::vector<Vec3>& points);

  /// Places in the order of the tree, neighbours together.
  std::size_t size() const { return points_.size(); }
  const Vec3& point(int place) const { return points_[static_cast<std::size_t>(place)]; }
  /// Index as given.
  int original(int place) const { return order_[static_cast<std::size_t>(place)]; }

  /// Replaces `places` by those of the points in the ball.
  void find_in(const Sphere& ball, std::vector<int>& places) const;

 private:
  struct Node {
    Box box;
    int first = 0;
    int count = 0;
    int left = 0;  ///< the right child follows; 0: a leaf
  };
  void build(std::size_t node, const std::vector<Vec3>& points);

  std::vector<int> order_;
  std::vector<Vec3> points_;  ///< ordered
  std::vector<Node> nodes_;
};

}  // namespace eigengrasp
