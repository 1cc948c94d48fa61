// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

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
  using Int4 = int __attribute__((vector_size(16)));
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(v) & 0x7fffffff);  // without the sign
}
inline float largest(Float4 v) {
  return std::max(std::max(v[0], v[1]), v[2]);
}

template <int i>
Float4 spread(Float4 v) {
  return __builtin_shufflevector(v, v, i, i, i, i);
}

/// An oriented box in the frame of a query. Component i of rows[k] is component k of axis i.
struct TurnedBox {
  Float4 rows[3];
  Float4 half;
  Float4 center;
};

inline TurnedBox turned(const MeshBvh::OrientedBox& box) {
  return {{load(box.rows[0]), load(box.rows[1]), load(box.rows[2])}, load(box.half), load(box.center)};
}

/// Half the extent of `other` along each axis of `box`.
inline Float4 extent_along(const TurnedBox& box, const TurnedBox& other) {
  const auto of_axis = [&](auto axis) {
    constexpr int i = axis;
    return spread<i>(other.half) *
           magnitude(spread<i>(other.rows[0]) * box.rows[0] + spread<i>(other.rows[1]) * box.rows[1] +
                     spread<i>(other.rows[2]) * box.rows[2]);
  };
  using std::integral_constant;
  return of_axis(integral_constant<int, 0>{}) + of_axis(integral_constant<int, 1>{}) +
         of_axis(integral_constant<int, 2>{});
}

/// Lower bound [m] of the distance of two oriented boxes, from the axes of both; negative where they overlap
/// along each of them.
inline float separation(const TurnedBox& a, const TurnedBox& b) {
  const Float4 d = b.center - a.center;
  const Float4 x = spread<0>(d);
  const Float4 y = spread<1>(d);
  const Float4 z = spread<2>(d);
  const Float4 of_a = magnitude(x * a.rows[0] + y * a.rows[1] + z * a.rows[2]) - a.half - extent_along(a, b);
  const Float4 of_b = magnitude(x * b.rows[0] + y * b.rows[1] + z * b.rows[2]) - b.half - extent_along(b, a);
  return largest(of_a > of_b ? of_a : of_b);
}

/// The oriented boxes of surface b as seen from the frame of surface a.
class PosedBoxes {
 public:
  PosedBoxes(const MeshBvh& a, const MeshBvh& b, const Pose& X_AB) : b_(b) {
    for (int c = 0; c < 3; ++c) {
      columns_[c] = Float4{static_cast<float>(X_AB.linear()(0, c)), static_cast<float>(X_AB.linear()(1, c)),
                           static_cast<float>(X_AB.linear()(2, c)), 0.0f};
      for (int r = 0; r < 3; ++r) elements_[r][c] = Float4{} + static_cast<float>(X_AB.linear()(r, c));
    }
    const Vec3& t = X_AB.translation();
    origin_ = Float4{static_cast<float>(t.x()), static_cast<float>(t.y()), static_cast<float>(t.z()), 0.0f};
    const double size = a.box().min.cwiseAbs().cwiseMax(a.box().max.cwiseAbs()).norm() +
                        b.box().min.cwiseAbs().cwiseMax(b.box().max.cwiseAbs()).norm() +
                        X_AB.translation().norm();
    rounding_ = static_cast<float>(4e-6 * size);
  }

  TurnedBox box(int node) const {
    const MeshBvh::OrientedBox& local = b_.oriented_box(node);
    const Float4 x = load(local.rows[0]);
    const Float4 y = load(local.rows[1]);
    const Float4 z = load(local.rows[2]);
    TurnedBox box;
    for (int r = 0; r < 3; ++r) box.rows[r] = elements_[r][0] * x + elements_[r][1] * y + elements_[r][2] * z;
    box.center = origin_ + local.center[0] * columns_[0] + local.center[1] * columns_[1] +
                 local.center[2] * columns_[2];
    box.half = load(local.half) + rounding_;
    return box;
  }

  /// A ball about the box.
  struct Ball {
    Float4 center;
    float radius;
  };
  Ball ball(int node) const {
    const MeshBvh::OrientedBox& local = b_.oriented_box(node);
    const Float4 half = load(local.half) + rounding_;
    const Float4 squares = half * half;
    return {origin_ + local.center[0] * columns_[0] + local.center[1] * columns_[1] +
                local.center[2] * columns_[2],
            1.000001f * std::sqrt(squares[0] + squares[1] + squares[2])};
  }

 private:
  const MeshBvh& b_;
  Float4 columns_[3];      ///< of the rotation
  Float4 elements_[3][3];  ///< of the rotation, each four times
  Float4 origin_;
  float rounding_;  ///< [m] more than single precision may be off; boxes are larger by so much
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
    int visits;  ///< so far, when it was found to matter
  };
  if (a.empty() || b.empty()) return;
  const PosedBoxes posed(a, b, X_AB);
  NodePair stack[256];
  int top = 0;
  int visits = 0;
  stack[top++] = {0, 0, separation(turned(a.oriented_box(0)), posed.box(0)), -1};
  while (top > 0) {
    const NodePair pair = stack[--top];
    const TurnedBox box_b = posed.box(pair.b);
    const MeshBvh::Node& na = a.nodes()[static_cast<std::size_t>(pair.a)];
    if (pair.visits != visits && !matters(pair.gap, na, box_b)) continue;
    const MeshBvh::Node& nb = b.nodes()[static_cast<std::size_t>(pair.b)];
    if (na.count > 0 && nb.count > 0) {
      if (visit(na, nb)) return;
      ++visits;
      continue;
    }
    const TurnedBox box_a = turned(a.oriented_box(pair.a));
    const bool split_a = nb.count > 0 || (na.count == 0 && largest(box_a.half) >= largest(box_b.half));
    const int first = top;
    for (int child = 0; child < 2; ++child) {
      const NodePair next = split_a ? NodePair{na.left + child, pair.b, 0.0, visits}
                                    : NodePair{pair.a, nb.left + child, 0.0, visits};
      const TurnedBox next_b = split_a ? box_b : posed.box(next.b);
      const double gap = separation(split_a ? turned(a.oriented_box(next.a)) : box_a, next_b);
      if (matters(gap, a.nodes()[static_cast<std::size_t>(next.a)], next_b))
        stack[top++] = {next.a, next.b, gap, visits};
    }
    if (top == first + 2 && stack[first].gap < stack[first + 1].gap)
      std::swap(stack[first], stack[first + 1]);
  }
}

}  // namespace eigengrasp::detail
