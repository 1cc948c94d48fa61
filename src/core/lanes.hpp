// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>

/// Sixteen numbers that are worked on together ("lanes"), over a backend that knows the registers of one
/// instruction set (lanes_baseline.hpp, lanes_avx2.hpp, lanes_avx512.hpp). Every operation rounds as IEEE 754
/// says and none is contracted, so that all backends give the same bits. Nothing of the standard library is
/// used here: its inline functions would be compiled with instructions that other processors lack, and the
/// linker might pick those for the whole program.
namespace eigengrasp::kernel {

inline constexpr int n_lanes = 16;

#define EIGENGRASP_LANES_INLINE [[gnu::always_inline]] inline

template <class B>
struct Mask {
  static constexpr int n = n_lanes / B::width;
  typename B::M v[n];
};

template <class B>
struct Floats {
  static constexpr int n = n_lanes / B::width;
  typename B::F v[n];
  Floats() = default;
  EIGENGRASP_LANES_INLINE Floats(float x) {  // NOLINT: a number stands for sixteen of it
    for (int k = 0; k < n; ++k) v[k] = B::set1(x);
  }
};

template <class B>
struct Ints {
  static constexpr int n = n_lanes / B::width;
  typename B::I v[n];
  Ints() = default;
  EIGENGRASP_LANES_INLINE Ints(std::int32_t x) {  // NOLINT: as above
    for (int k = 0; k < n; ++k) v[k] = B::set1_int(x);
  }
};

// One line an operation: result type, name, parameters, and the backend's function for each register.
#define EIGENGRASP_LANES_BINARY(Result, name, Type, function)                  \
  template <class B>                                                           \
  EIGENGRASP_LANES_INLINE Result<B> name(const Type<B>& a, const Type<B>& b) { \
    Result<B> r;                                                               \
    for (int k = 0; k < Type<B>::n; ++k) r.v[k] = B::function(a.v[k], b.v[k]); \
    return r;                                                                  \
  }
#define EIGENGRASP_LANES_UNARY(Result, name, Type, function)           \
  template <class B>                                                   \
  EIGENGRASP_LANES_INLINE Result<B> name(const Type<B>& a) {           \
    Result<B> r;                                                       \
    for (int k = 0; k < Type<B>::n; ++k) r.v[k] = B::function(a.v[k]); \
    return r;                                                          \
  }

EIGENGRASP_LANES_BINARY(Floats, operator+, Floats, add)
EIGENGRASP_LANES_BINARY(Floats, operator-, Floats, sub)
EIGENGRASP_LANES_BINARY(Floats, operator*, Floats, mul)
EIGENGRASP_LANES_BINARY(Floats, operator/, Floats, div)
EIGENGRASP_LANES_BINARY(Floats, min, Floats, min)
EIGENGRASP_LANES_BINARY(Floats, max, Floats, max)
EIGENGRASP_LANES_BINARY(Mask, operator<, Floats, less)
EIGENGRASP_LANES_BINARY(Mask, operator<=, Floats, less_equal)
EIGENGRASP_LANES_UNARY(Floats, sqrt, Floats, sqrt)
EIGENGRASP_LANES_UNARY(Floats, abs, Floats, abs)
EIGENGRASP_LANES_UNARY(Ints, truncate, Floats, truncate)  // towards 0
EIGENGRASP_LANES_UNARY(Floats, to_float, Ints, to_float)
EIGENGRASP_LANES_UNARY(Ints, bits_of, Floats, bits_of)
EIGENGRASP_LANES_UNARY(Floats, float_of_bits, Ints, float_of_bits)
EIGENGRASP_LANES_BINARY(Ints, operator+, Ints, add_int)
EIGENGRASP_LANES_BINARY(Ints, operator-, Ints, sub_int)
EIGENGRASP_LANES_BINARY(Ints, operator*, Ints, mul_int)
EIGENGRASP_LANES_BINARY(Ints, operator^, Ints, xor_int)
EIGENGRASP_LANES_BINARY(Ints, operator|, Ints, or_int)
EIGENGRASP_LANES_BINARY(Ints, operator&, Ints, and_int)
EIGENGRASP_LANES_BINARY(Mask, operator&, Mask, mask_and)
EIGENGRASP_LANES_BINARY(Mask, operator|, Mask, mask_or)
EIGENGRASP_LANES_BINARY(Mask, and_not, Mask, mask_and_not)  // a and not b

#undef EIGENGRASP_LANES_BINARY
#undef EIGENGRASP_LANES_UNARY

template <int bits, class B>
EIGENGRASP_LANES_INLINE Ints<B> shift_left(const Ints<B>& a) {
  Ints<B> r;
  for (int k = 0; k < Ints<B>::n; ++k) r.v[k] = B::template shift_left<bits>(a.v[k]);
  return r;
}
template <int bits, class B>  // logical: zeros come in
EIGENGRASP_LANES_INLINE Ints<B> shift_right(const Ints<B>& a) {
  Ints<B> r;
  for (int k = 0; k < Ints<B>::n; ++k) r.v[k] = B::template shift_right<bits>(a.v[k]);
  return r;
}
/// a where the mask holds, else b.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> select(const Mask<B>& m, const Floats<B>& a, const Floats<B>& b) {
  Floats<B> r;
  for (int k = 0; k < Floats<B>::n; ++k) r.v[k] = B::select(m.v[k], a.v[k], b.v[k]);
  return r;
}
template <class B>
EIGENGRASP_LANES_INLINE Ints<B> select(const Mask<B>& m, const Ints<B>& a, const Ints<B>& b) {
  Ints<B> r;
  for (int k = 0; k < Ints<B>::n; ++k) r.v[k] = B::select_int(m.v[k], a.v[k], b.v[k]);
  return r;
}
/// One bit a lane, lane 0 lowest.
template <class B>
EIGENGRASP_LANES_INLINE std::uint32_t bits(const Mask<B>& m) {
  std::uint32_t r = 0;
  for (int k = 0; k < Mask<B>::n; ++k) r |= B::bits(m.v[k]) << (k * B::width);
  return r;
}
/// @pre p aligned to 64 bytes
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> load(const float* p) {
  Floats<B> r;
  for (int k = 0; k < Floats<B>::n; ++k) r.v[k] = B::load(p + k * B::width);
  return r;
}
template <class B>
EIGENGRASP_LANES_INLINE void store(float* p, const Floats<B>& a) {
  for (int k = 0; k < Floats<B>::n; ++k) B::store(p + k * B::width, a.v[k]);
}
template <class B>
EIGENGRASP_LANES_INLINE Ints<B> load_ints(const std::int32_t* p) {
  Ints<B> r;
  for (int k = 0; k < Ints<B>::n; ++k) r.v[k] = B::load_int(p + k * B::width);
  return r;
}
template <class B>
EIGENGRASP_LANES_INLINE void store_ints(std::int32_t* p, const Ints<B>& a) {
  for (int k = 0; k < Ints<B>::n; ++k) B::store_int(p + k * B::width, a.v[k]);
}
/// base[index] of each lane.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> gather(const float* base, const Ints<B>& index) {
  Floats<B> r;
  for (int k = 0; k < Floats<B>::n; ++k) r.v[k] = B::gather(base, index.v[k]);
  return r;
}
template <class B>
EIGENGRASP_LANES_INLINE Ints<B> gather(const std::int32_t* base, const Ints<B>& index) {
  Ints<B> r;
  for (int k = 0; k < Ints<B>::n; ++k) r.v[k] = B::gather_int(base, index.v[k]);
  return r;
}
/// base[index] and base[index + 1] of each lane.
template <class B>
EIGENGRASP_LANES_INLINE void gather_pair(const std::int32_t* base, const Ints<B>& index, Ints<B>& first,
                                         Ints<B>& second) {
  for (int k = 0; k < Ints<B>::n; ++k) B::gather_pair(base, index.v[k], first.v[k], second.v[k]);
}
/// x in [low, high].
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> clamp(const Floats<B>& x, const Floats<B>& low, const Floats<B>& high) {
  return min(max(x, low), high);
}

}  // namespace eigengrasp::kernel
