// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <cmath>

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp::detail {

// GCC and Clang: four floats that are added and multiplied at once; the fourth is not used.
using Float4 = float __attribute__((vector_size(16)));

inline Float4 load(const float* p) {
  Float4 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
inline Float4 magnitude(Float4 v) {
  return v < 0.0f ? -v : v;
}
inline float largest(Float4 v) {
  return std::max(std::max(v[0], v[1]), v[2]);
}

/// An oriented box in the frame of a query. Component i of rows[k] is component k of axis i.
struct TurnedBox {
  Float4 rows[3];
  Float4 half;
  float center[3];
};

inline TurnedBox turned(const MeshBvh::OrientedBox& box) {
  return {{load(box.rows[0]), load(box.rows[1]), load(box.rows[2])},
          load(box.half),
          {box.center[0], box.center[1], box.center[2]}};
}

/// Lower bound [m] of the distance of two oriented boxes, from the axes of both; negative where they overlap
/// along each of them. Off by what rounding to float makes of their coordinates.
inline float separation(const TurnedBox& a, const TurnedBox& b) {
  const float d[3] = {b.center[0] - a.center[0], b.center[1] - a.center[1], b.center[2] - a.center[2]};
  const auto along = [&d](const TurnedBox& box) {
    return magnitude(d[0] * box.rows[0] + d[1] * box.rows[1] + d[2] * box.rows[2]);
  };
  /// Half the extent of `other` along each axis of `box`.
  const auto extent = [](const TurnedBox& box, const TurnedBox& other) {
    Float4 sum = {};
    for (int m = 0; m < 3; ++m)
      sum += other.half[m] * magnitude(other.rows[0][m] * box.rows[0] + other.rows[1][m] * box.rows[1] +
                                       other.rows[2][m] * box.rows[2]);
    return sum;
  };
  return std::max(largest(along(a) - a.half - extent(a, b)), largest(along(b) - b.half - extent(b, a)));
}

/// The oriented boxes of surface b as seen from the frame of surface a.
class PosedBoxes {
 public:
  PosedBoxes(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB) : b_(b) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) R_[r][c] = static_cast<float>(X_AB.linear()(r, c));
      t_[r] = static_cast<float>(X_AB.translation()[r]);
    }
    const double size = a.box().min.cwiseAbs().cwiseMax(a.box().max.cwiseAbs()).norm() +
                        b.box().min.cwiseAbs().cwiseMax(b.box().max.cwiseAbs()).norm() +
                        X_AB.translation().norm();
    rounding_ = 4e-6 * size;
  }

  TurnedBox box(int node) const {
    const MeshBvh::OrientedBox& local = b_.oriented_box(node);
    const Float4 rows[3] = {load(local.rows[0]), load(local.rows[1]), load(local.rows[2])};
    TurnedBox box;
    for (int r = 0; r < 3; ++r) {
      box.rows[r] = R_[r][0] * rows[0] + R_[r][1] * rows[1] + R_[r][2] * rows[2];
      box.center[r] =
          R_[r][0] * local.center[0] + R_[r][1] * local.center[1] + R_[r][2] * local.center[2] + t_[r];
    }
    box.half = load(local.half);
    return box;
  }

  /// More than the error [m] of a separation.
  double rounding() const { return rounding_; }

 private:
  const MeshBvh& b_;
  float R_[3][3];
  float t_[3];
  double rounding_;
};

/// Simultaneous descent of two hierarchies, the larger node first, then the nearer pair: calls
/// visit(node of a, node of b) for the leaves for which and for all above them matters(gap, node of a, box of
/// b) says so (which may change its mind meanwhile); gap is a lower bound of their distance [m]. Stops where
/// visit returns true.
template <typename Matters, typename Visit>
void descend(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB, Matters matters, Visit visit) {
  struct NodePair {
    int a;
    int b;
    double gap;
  };
  if (a.empty() || b.empty()) return;
  const PosedBoxes posed(a, b, X_AB);
  const auto gap_of = [&](const TurnedBox& box_a, const TurnedBox& box_b) {
    return static_cast<double>(separation(box_a, box_b)) - posed.rounding();
  };
  NodePair stack[256];
  int top = 0;
  stack[top++] = {0, 0, gap_of(turned(a.oriented_box(0)), posed.box(0))};
  while (top > 0) {
    const NodePair pair = stack[--top];
    const TurnedBox box_b = posed.box(pair.b);
    const MeshBvh::Node& na = a.nodes()[static_cast<std::size_t>(pair.a)];
    if (!matters(pair.gap, na, box_b)) continue;
    const MeshBvh::Node& nb = b.nodes()[static_cast<std::size_t>(pair.b)];
    if (na.count > 0 && nb.count > 0) {
      if (visit(na, nb)) return;
      continue;
    }
    const TurnedBox box_a = turned(a.oriented_box(pair.a));
    const bool split_a = nb.count > 0 || (na.count == 0 && largest(box_a.half) >= largest(box_b.half));
    const int first = top;
    for (int child = 0; child < 2; ++child) {
      const NodePair next =
          split_a ? NodePair{na.left + child, pair.b, 0.0} : NodePair{pair.a, nb.left + child, 0.0};
      const TurnedBox next_b = split_a ? box_b : posed.box(next.b);
      const double gap = gap_of(split_a ? turned(a.oriented_box(next.a)) : box_a, next_b);
      if (matters(gap, a.nodes()[static_cast<std::size_t>(next.a)], next_b))
        stack[top++] = {next.a, next.b, gap};
    }
    if (top == first + 2 && stack[first].gap < stack[first + 1].gap)
      std::swap(stack[first], stack[first + 1]);
  }
}

}  // namespace eigengrasp::detail
