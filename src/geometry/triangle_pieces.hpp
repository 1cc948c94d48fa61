// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>

#include "eigengrasp/geometry/triangle_queries.hpp"

namespace eigengrasp::detail {

/// The same triangle, turned.
inline TriangleCorners longest_side_first(const TriangleCorners& t) {
  const double ab = (t.b - t.a).squaredNorm();
  const double bc = (t.c - t.b).squaredNorm();
  const double ca = (t.a - t.c).squaredNorm();
  if (ab >= bc && ab >= ca) return t;
  return bc >= ca ? TriangleCorners{t.b, t.c, t.a} : TriangleCorners{t.c, t.a, t.b};
}

/// Halves a triangle along its longest side until no side is longer than `side`.
template <typename Visit>
void visit_pieces(const TriangleCorners& t, double side, const Visit& visit) {
  const TriangleCorners s = longest_side_first(t);
  if ((s.b - s.a).squaredNorm() <= side * side) {
    visit(s);
    return;
  }
  const Vec3 middle = 0.5 * (s.a + s.b);
  visit_pieces({s.b, s.c, middle}, side, visit);
  visit_pieces({s.c, s.a, middle}, side, visit);
}

inline Vec3 center_of(const TriangleCorners& t) {
  return (t.a + t.b + t.c) / 3.0;
}

/// Distance of the farthest corner.
inline double size_about(const TriangleCorners& t, const Vec3& center) {
  return std::sqrt(
      std::max({(t.a - center).squaredNorm(), (t.b - center).squaredNorm(), (t.c - center).squaredNorm()}));
}

}  // namespace eigengrasp::detail
