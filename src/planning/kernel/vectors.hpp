// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lane_vectors.hpp"
#include "planning/kernel/program.hpp"

/// Motions, sine and cosine in lanes.
namespace eigengrasp::kernel {

template <class B>
struct Motion {
  Vector<B> ex, ey, ez;  ///< columns of the rotation
  Vector<B> p;
};

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> turned(const Motion<B>& X, const Vector<B>& a) {
  return a.x * X.ex + a.y * X.ey + a.z * X.ez;
}
template <class B>
EIGENGRASP_LANES_INLINE Vector<B> moved(const Motion<B>& X, const Vector<B>& a) {
  return turned(X, a) + X.p;
}
/// X times a constant motion.
template <class B>
EIGENGRASP_LANES_INLINE Motion<B> times(const Motion<B>& X, const Transform& c) {
  const auto column = [&](int k) {
    return Vector<B>{Floats<B>(c.R[k]), Floats<B>(c.R[3 + k]), Floats<B>(c.R[6 + k])};
  };
  return {turned(X, column(0)), turned(X, column(1)), turned(X, column(2)), moved(X, splat<B>(c.p))};
}
template <class B>
EIGENGRASP_LANES_INLINE Motion<B> load_motion(const float* pose) {
  const auto at = [&](int k) {
    return Vector<B>{load<B>(pose + k * n_lanes), load<B>(pose + (k + 1) * n_lanes),
                     load<B>(pose + (k + 2) * n_lanes)};
  };
  return {at(0), at(3), at(6), at(9)};
}
template <class B>
EIGENGRASP_LANES_INLINE void store_motion(float* pose, const Motion<B>& X) {
  const auto put = [&](int k, const Vector<B>& v) {
    store<B>(pose + k * n_lanes, v.x);
    store<B>(pose + (k + 1) * n_lanes, v.y);
    store<B>(pose + (k + 2) * n_lanes, v.z);
  };
  put(0, X.ex);
  put(3, X.ey);
  put(6, X.ez);
  put(9, X.p);
}
/// The same constant motion in every lane.
template <class B>
EIGENGRASP_LANES_INLINE Motion<B> splat_motion(const Transform& c) {
  const auto column = [&](int k) {
    return Vector<B>{Floats<B>(c.R[k]), Floats<B>(c.R[3 + k]), Floats<B>(c.R[6 + k])};
  };
  return {column(0), column(1), column(2), splat<B>(c.p)};
}

/// The motion of one lane in every lane. @param pose stored motion, from the lane on
template <class B>
EIGENGRASP_LANES_INLINE Motion<B> splat_lane(const float* pose) {
  const auto at = [&](int k) {
    return Vector<B>{Floats<B>(pose[k * n_lanes]), Floats<B>(pose[(k + 1) * n_lanes]),
                     Floats<B>(pose[(k + 2) * n_lanes])};
  };
  return {at(0), at(3), at(6), at(9)};
}

template <class B>
struct SineCosine {
  Floats<B> sine, cosine;
};

/// Of an angle within some hundred turns. Error: 1e-7. Reduced to [-pi/4, pi/4] in three steps (Cody and
/// Waite 1980), then Taylor polynomials.
template <class B>
EIGENGRASP_LANES_INLINE SineCosine<B> sine_cosine(const Floats<B>& angle) {
  using F = Floats<B>;
  const F turns = angle * F(0.636619772f);  // quarter turns
  const Ints<B> quarter = truncate(turns + select(turns < F(0.0f), F(-0.5f), F(0.5f)));
  const F q = to_float(quarter);
  const F x = ((angle - q * F(1.5703125f)) - q * F(4.837512969970703e-4f)) - q * F(7.549789948768648e-8f);
  const F x2 = x * x;
  const F s = x + x * x2 *
                      (F(-1.6666667e-1f) +
                       x2 * (F(8.3333333e-3f) + x2 * (F(-1.9841270e-4f) + x2 * F(2.7557319e-6f))));
  const F c =
      F(1.0f) + x2 * (F(-0.5f) + x2 * (F(4.1666667e-2f) + x2 * (F(-1.3888889e-3f) + x2 * F(2.4801587e-5f))));
  const auto odd = F(0.0f) < to_float(quarter & Ints<B>(1));
  const F sine = select(odd, c, s);
  const F cosine = select(odd, s, c);
  const Ints<B> sine_sign = shift_left<30>(quarter & Ints<B>(2));
  const Ints<B> cosine_sign = shift_left<30>((quarter + Ints<B>(1)) & Ints<B>(2));
  return {float_of_bits(bits_of(sine) ^ sine_sign), float_of_bits(bits_of(cosine) ^ cosine_sign)};
}

}  // namespace eigengrasp::kernel
