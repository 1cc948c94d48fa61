// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lanes.hpp"

/// Points and vectors in lanes.
namespace eigengrasp::kernel {

template <class B>
struct Vector {
  Floats<B> x, y, z;
};

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> operator+(const Vector<B>& a, const Vector<B>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class B>
EIGENGRASP_LANES_INLINE Vector<B> operator-(const Vector<B>& a, const Vector<B>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class B>
EIGENGRASP_LANES_INLINE Vector<B> operator*(const Floats<B>& s, const Vector<B>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> dot(const Vector<B>& a, const Vector<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class B>
EIGENGRASP_LANES_INLINE Vector<B> cross(const Vector<B>& a, const Vector<B>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class B>
EIGENGRASP_LANES_INLINE Vector<B> splat(const float* p) {
  return {Floats<B>(p[0]), Floats<B>(p[1]), Floats<B>(p[2])};
}

}  // namespace eigengrasp::kernel
