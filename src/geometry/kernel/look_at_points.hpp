// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lane_vectors.hpp"
#include "geometry/kernel/point_looks.hpp"

namespace eigengrasp::point_kernel {
namespace {

using kernel::Floats;
using kernel::Mask;
using kernel::splat;
using kernel::Vector;

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> load_points(const Points& p) {
  return {kernel::load<B>(p.x), kernel::load<B>(p.y), kernel::load<B>(p.z)};
}

// Distances that differ by less are of triangles with a corner or a side in common.
constexpr float same = 1e-5f;      // relative to the square
constexpr float nothing = 1e-16f;  // [m^2]

template <class B>
bool reach_box(const Points& points, const float (&box)[6]) {
  using F = Floats<B>;
  const F zero(0.0f);
  const auto outside = [&](const F& x, int k) { return max(max(F(box[k]) - x, x - F(box[3 + k])), zero); };
  const Vector<B> p = load_points<B>(points);
  const Vector<B> d{outside(p.x, 0), outside(p.y, 1), outside(p.z, 2)};
  const F most = kernel::load<B>(points.distance2) * F(1.0f + 2.0f * same) + F(nothing);
  return bits(dot(d, d) < most) != 0;
}

/// Squared distance to the side from a along the vector to the next corner.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> side_distance2(const Vector<B>& side, const Vector<B>& from_a) {
  using F = Floats<B>;
  const F length2 = max(dot(side, side), F(1e-30f));
  const F share = kernel::clamp(dot(side, from_a) / length2, F(0.0f), F(1.0f));
  const Vector<B> off = from_a - share * side;
  return dot(off, off);
}

/// The face is nearest where the point lies inside of all three sides, else one of the sides.
template <class B>
void meet_triangle(Points& points, const float (&corners)[9], std::int32_t number) {
  using F = Floats<B>;
  const Vector<B> a = splat<B>(corners);
  const Vector<B> b = splat<B>(corners + 3);
  const Vector<B> c = splat<B>(corners + 6);
  const Vector<B> p = load_points<B>(points);
  const Vector<B> ab = b - a;
  const Vector<B> bc = c - b;
  const Vector<B> ca = a - c;
  const Vector<B> n = cross(ab, c - a);
  const Vector<B> pa = p - a;
  const Vector<B> pb = p - b;
  const Vector<B> pc = p - c;
  const F sides = min(min(side_distance2(ab, pa), side_distance2(bc, pb)), side_distance2(ca, pc));
  const F inside = min(min(dot(cross(n, ab), pa), dot(cross(n, bc), pb)), dot(cross(n, ca), pc));
  const F height = dot(n, pa);
  const F face = height * height / max(dot(n, n), F(1e-30f));
  const F found = select(F(0.0f) < inside, min(face, sides), sides);
  const F before = kernel::load<B>(points.distance2);
  const F height_before = kernel::load<B>(points.height2);
  const Mask<B> nearer = found < before * F(1.0f - same) - F(nothing);
  const Mask<B> as_near = (found < before * F(1.0f + same) + F(nothing)) & (height_before < face);
  const Mask<B> better = nearer | as_near;
  kernel::store(points.distance2, select(better, min(found, before), before));
  kernel::store(points.height2, select(better, face, height_before));
  kernel::store_ints(points.triangle,
                     select(better, kernel::Ints<B>(number), kernel::load_ints<B>(points.triangle)));
}

}  // namespace
}  // namespace eigengrasp::point_kernel
