// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "geometry/kernel/box_looks.hpp"

namespace eigengrasp::box_kernel {
namespace {

using kernel::Floats;
using kernel::Mask;

template <class B>
struct Boxes {
  Floats<B> row[3][3];  ///< component r of axis k
  Floats<B> half[3];
  Floats<B> center[3];
};

template <class B>
EIGENGRASP_LANES_INLINE Boxes<B> loaded(const float* boxes, const std::int32_t* numbers) {
  const kernel::Ints<B> at = kernel::load_ints<B>(numbers) * kernel::Ints<B>(box_stride);
  Boxes<B> box;
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k) box.row[r][k] = kernel::gather<B>(boxes + 4 * r + k, at);
    box.half[r] = kernel::gather<B>(boxes + 12 + r, at);
    box.center[r] = kernel::gather<B>(boxes + 16 + r, at);
  }
  return box;
}

template <class B>
EIGENGRASP_LANES_INLINE Boxes<B> posed(const Boxes<B>& own, const Placement& place) {
  Boxes<B> box;
  for (int r = 0; r < 3; ++r) {
    const Floats<B> x(place.rotation[r][0]);
    const Floats<B> y(place.rotation[r][1]);
    const Floats<B> z(place.rotation[r][2]);
    for (int k = 0; k < 3; ++k) box.row[r][k] = x * own.row[0][k] + y * own.row[1][k] + z * own.row[2][k];
    box.center[r] = Floats<B>(place.origin[r]) + x * own.center[0] + y * own.center[1] + z * own.center[2];
    box.half[r] = own.half[r] + Floats<B>(place.rounding);
  }
  return box;
}

template <class B>
EIGENGRASP_LANES_INLINE Floats<B> dot(const Floats<B>* v, const Boxes<B>& box, int axis) {
  return v[0] * box.row[0][axis] + v[1] * box.row[1][axis] + v[2] * box.row[2][axis];
}

/// Vector between the centres and the gap along each axis of both boxes, a's first.
template <class B>
struct Gaps {
  Floats<B> along[6];
  Floats<B> gap[6];
  Floats<B> largest;
};

template <class B>
EIGENGRASP_LANES_INLINE Gaps<B> gaps_of(const Boxes<B>& a, const Boxes<B>& b) {
  Gaps<B> g;
  const Floats<B> d[3] = {b.center[0] - a.center[0], b.center[1] - a.center[1], b.center[2] - a.center[2]};
  Floats<B> extent[6];
  for (int k = 0; k < 3; ++k) {
    g.along[k] = dot(d, a, k);
    g.along[3 + k] = dot(d, b, k);
    extent[k] = a.half[k];
    extent[3 + k] = b.half[k];
  }
  for (int k = 0; k < 3; ++k) {
    const Floats<B> axis[3] = {a.row[0][k], a.row[1][k], a.row[2][k]};
    for (int i = 0; i < 3; ++i) {
      const Floats<B> cosine = abs(dot(axis, b, i));
      extent[k] = extent[k] + b.half[i] * cosine;
      extent[3 + i] = extent[3 + i] + a.half[k] * cosine;
    }
  }
  for (int k = 0; k < 6; ++k) {
    g.gap[k] = abs(g.along[k]) - extent[k];
    g.largest = k == 0 ? g.gap[0] : max(g.largest, g.gap[k]);
  }
  return g;
}

/// Not less than the root of 1 - c^2, for cosines c: tangents of the root.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> sine_bound(const Floats<B>& c) {
  const Floats<B> square = max(Floats<B>(1.000001f) - c * c, Floats<B>(0.0f));
  return min(
      min(Floats<B>(0.5f) + Floats<B>(0.5f) * square, Floats<B>(0.16666667f) + Floats<B>(1.5f) * square),
      Floats<B>(0.05001f) + Floats<B>(5.0f) * square);
}

/// Adds how fast one joint closes the gap along each axis at most, at first. @param box that it moves
template <class B>
EIGENGRASP_LANES_INLINE void add_rates(const Joint& joint, float side, const Boxes<B>& box,
                                       const Floats<B>& radius, const Floats<B> (*n)[3], Floats<B>* rates) {
  const auto c = [&](float x) { return Floats<B>(side * x); };
  const float* w = joint.angular;
  const Floats<B>* p = box.center;
  const Floats<B> v[3] = {c(joint.linear[0]) + (c(w[1]) * p[2] - c(w[2]) * p[1]),
                          c(joint.linear[1]) + (c(w[2]) * p[0] - c(w[0]) * p[2]),
                          c(joint.linear[2]) + (c(w[0]) * p[1] - c(w[1]) * p[0])};
  const Floats<B> turn = Floats<B>(joint.spin) * radius;
  const Floats<B> x(joint.axis[0]);
  const Floats<B> y(joint.axis[1]);
  const Floats<B> z(joint.axis[2]);
  for (int k = 0; k < 6; ++k) {
    const Floats<B> cosine = n[k][0] * x + n[k][1] * y + n[k][2] * z;
    const Floats<B> speed = n[k][0] * v[0] + n[k][1] * v[1] + n[k][2] * v[2];
    rates[k] = rates[k] + max(speed + turn * sine_bound(cosine), Floats<B>(0.0f));
  }
}

template <class B>
EIGENGRASP_LANES_INLINE Floats<B> radius_of(const Boxes<B>& box) {
  return Floats<B>(1.000001f) *
         sqrt(box.half[0] * box.half[0] + box.half[1] * box.half[1] + box.half[2] * box.half[2]);
}

/// Time in which the gap is closed along the axis that seems to tell the most.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> time_of(const Gaps<B>& gaps, const Floats<B>* rates, const Motion& motion) {
  const Floats<B> zero(0.0f);
  const Floats<B> gained(0.5f * motion.acceleration * motion.outlook);
  Floats<B> free = zero - Floats<B>(1.0f);
  Floats<B> mean(1.0f);
  for (int k = 0; k < 6; ++k) {
    const Floats<B> free_k = gaps.gap[k] - Floats<B>(motion.margin);
    const Floats<B> mean_k = Floats<B>(1.00001f) * rates[k] + gained;
    const Mask<B> better = free * mean_k < free_k * mean;
    free = select(better, free_k, free);
    mean = select(better, mean_k, mean);
  }
  const Floats<B> positive = max(free, zero);
  const Floats<B> rate = mean - gained + Floats<B>(1e-6f) * gained;
  const Floats<B> root = sqrt(rate * rate + Floats<B>(2.0f * motion.acceleration) * positive);
  return select(zero < free, Floats<B>(1.99998f) * positive / (rate + root), zero);
}

template <class B>
void gaps(const Placement& place, Pairs& pairs) {
  store(pairs.gap,
        gaps_of(loaded<B>(pairs.boxes_a, pairs.a), posed(loaded<B>(pairs.boxes_b, pairs.b), place)).largest);
}

template <class B>
void times(const Placement& place, const Motion& motion, Pairs& pairs) {
  const Boxes<B> a = loaded<B>(pairs.boxes_a, pairs.a);
  const Boxes<B> b = posed(loaded<B>(pairs.boxes_b, pairs.b), place);
  const Gaps<B> g = gaps_of(a, b);
  store(pairs.gap, g.largest);
  const Floats<B> zero(0.0f);
  if (bits(Floats<B>(motion.margin) < g.largest) == 0) {
    store(pairs.time, zero);
    return;
  }
  Floats<B> n[6][3];  // from b to a
  for (int k = 0; k < 6; ++k)
    for (int r = 0; r < 3; ++r) {
      const Floats<B>& axis = k < 3 ? a.row[r][k] : b.row[r][k - 3];
      n[k][r] = select(zero < g.along[k], zero - axis, axis);
    }
  Floats<B> rates[6] = {zero, zero, zero, zero, zero, zero};
  const Floats<B> radius_a = radius_of(a);
  const Floats<B> radius_b = radius_of(b);
  for (int j = 0; j < motion.n_of_a; ++j) add_rates(motion.joints[j], -1.0f, a, radius_a, n, rates);
  for (int j = motion.n_of_a; j < motion.n; ++j) add_rates(motion.joints[j], 1.0f, b, radius_b, n, rates);
  store(pairs.time, time_of(g, rates, motion));
}

}  // namespace
}  // namespace eigengrasp::box_kernel
