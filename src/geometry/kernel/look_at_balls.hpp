// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lane_vectors.hpp"
#include "geometry/kernel/ball_looks.hpp"

namespace eigengrasp::ball_kernel {
namespace {

using kernel::Floats;
using kernel::Ints;
using kernel::Mask;
using kernel::splat;
using kernel::Vector;

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> place_in(const GridView& g, const Vector<B>& p) {
  return Floats<B>(g.inverse_cell) * (p - splat<B>(g.origin));
}

template <class B>
EIGENGRASP_LANES_INLINE Mask<B> inside(const GridView& g, const Vector<B>& u) {
  const Floats<B> zero(0.0f);
  return (zero <= min(min(u.x, u.y), u.z)) & (u.x <= Floats<B>(g.last[0])) & (u.y <= Floats<B>(g.last[1])) &
         (u.z <= Floats<B>(g.last[2]));
}

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> clamp_to(const GridView& g, const Vector<B>& u) {
  const Floats<B> zero(0.0f);
  return {kernel::clamp(u.x, zero, Floats<B>(g.last[0])), kernel::clamp(u.y, zero, Floats<B>(g.last[1])),
          kernel::clamp(u.z, zero, Floats<B>(g.last[2]))};
}

template <class B>
EIGENGRASP_LANES_INLINE Floats<B> mix(const Floats<B>& a, const Floats<B>& b, const Floats<B>& t) {
  return a + t * (b - a);
}

/// Certain lower bound of the distance, see certain_distance: the trilinear value less what it may be off.
/// @param u place in the grid, inside of it
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> certain_value(const GridView& g, float scale, const Vector<B>& u) {
  using F = Floats<B>;
  const F one(1.0f);
  const F zero(0.0f);
  const auto first = [&](const F& x, float last) { return truncate(max(min(x, F(last) - one), zero)); };
  const Ints<B> ix = first(u.x, g.last[0]);
  const Ints<B> iy = first(u.y, g.last[1]);
  const Ints<B> iz = first(u.z, g.last[2]);
  const Ints<B> at = ix + iy * Ints<B>(g.row) + iz * Ints<B>(g.layer);
  F v[8];
  F least(0.0f);
  for (int k = 0; k < 4; ++k) {
    Ints<B> low;
    Ints<B> high;
    kernel::gather_pair<B>(g.values, at + Ints<B>((k & 1) * g.row + (k >> 1) * g.layer), low, high);
    v[2 * k] = abs(float_of_bits(low));
    v[2 * k + 1] = abs(float_of_bits(high));
    const F lower = min(v[2 * k], v[2 * k + 1]);
    least = k == 0 ? lower : min(least, lower);
  }
  const F fx = u.x - to_float(ix);
  const F fy = u.y - to_float(iy);
  const F fz = u.z - to_float(iz);
  const F value = mix(mix(mix(v[0], v[1], fx), mix(v[2], v[3], fx), fy),
                      mix(mix(v[4], v[5], fx), mix(v[6], v[7], fx), fy), fz);
  const F half_diagonal(0.8661f * g.cell);
  const F nearest = F(scale) * least - half_diagonal;
  const F bend(0.3752f * g.cell * g.cell);
  const F error = select(zero < nearest, min(half_diagonal, bend / max(nearest, F(1e-9f))), half_diagonal);
  return F(scale) * value - error;
}

/// Of any point; beyond the coarse grid by way of its border, behind which the whole surface lies.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> certain_distance(const Motion& m, const Vector<B>& p) {
  using F = Floats<B>;
  const Vector<B> fine = place_in(m.fine, p);
  const Mask<B> in_fine = inside(m.fine, fine);
  const std::uint32_t lanes = bits(in_fine);
  if (lanes == 0xffffu) return certain_value<B>(m.fine, m.scale, fine);
  const Vector<B> u = place_in(m.coarse, p);
  const F zero(0.0f);
  const Vector<B> at = clamp_to(m.coarse, u);
  const Vector<B> beyond = F(m.coarse.cell) * (u - at);
  const F beyond2 = dot(beyond, beyond);
  F value = certain_value<B>(m.coarse, m.scale, at);
  const F border = max(value, zero);
  value = select(zero < beyond2, sqrt(beyond2 + border * border), value);
  if (lanes == 0) return value;
  return select(in_fine, certain_value<B>(m.fine, m.scale, clamp_to(m.fine, fine)), value);
}

/// How fast a point can move at most, whichever joints stop: along each axis those count that move it one
/// way.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> speed_of(const Motion& m, const Vector<B>& p) {
  using F = Floats<B>;
  const F zero(0.0f);
  F forward[3] = {zero, zero, zero};
  F backward[3] = {zero, zero, zero};
  for (int j = 0; j < m.n; ++j) {
    const float* w = m.joints[j].angular;
    const float* l = m.joints[j].linear;
    const F v[3] = {F(l[0]) + (F(w[1]) * p.z - F(w[2]) * p.y), F(l[1]) + (F(w[2]) * p.x - F(w[0]) * p.z),
                    F(l[2]) + (F(w[0]) * p.y - F(w[1]) * p.x)};
    for (int k = 0; k < 3; ++k) {
      forward[k] = forward[k] + max(v[k], zero);
      backward[k] = backward[k] + max(zero - v[k], zero);
    }
  }
  F sum(0.0f);
  for (int k = 0; k < 3; ++k) {
    const F larger = max(forward[k], backward[k]);
    sum = sum + larger * larger;
  }
  return F(1.00001f) * sqrt(sum);
}

template <class B>
void times(const Motion& m, const BallPack& balls, float* times) {
  using F = Floats<B>;
  const F x = kernel::load<B>(balls.x);
  const F y = kernel::load<B>(balls.y);
  const F z = kernel::load<B>(balls.z);
  const auto row = [&](int r) {
    return F(m.origin[r]) + F(m.rotation[r][0]) * x + F(m.rotation[r][1]) * y + F(m.rotation[r][2]) * z;
  };
  const Vector<B> p{row(0), row(1), row(2)};
  const F gap = certain_distance<B>(m, p) - kernel::load<B>(balls.radius) - F(m.margin);
  const F zero(0.0f);
  const F positive = max(gap, zero);
  const F rate = speed_of<B>(m, p);
  // gap = rate t + acceleration t^2 / 2
  const F root = sqrt(rate * rate + F(2.0f * m.acceleration) * positive);
  kernel::store(times, select(zero < gap, F(1.99998f) * positive / max(rate + root, F(1e-12f)), zero));
}

}  // namespace
}  // namespace eigengrasp::ball_kernel
