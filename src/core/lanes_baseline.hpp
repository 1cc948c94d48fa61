// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "core/lanes.hpp"

namespace eigengrasp::kernel {
namespace {

/// Four registers of four, by the compiler's vector types: SSE2 on x86-64, NEON on 64-bit ARM.
struct Baseline {
  static constexpr int width = 4;
  using F [[gnu::vector_size(16)]] = float;
  using I [[gnu::vector_size(16)]] = std::int32_t;
  using U [[gnu::vector_size(16)]] = std::uint32_t;
  using M = I;
  static F set1(float x) { return F{x, x, x, x}; }
  static I set1_int(std::int32_t x) { return I{x, x, x, x}; }
  static F load(const float* p) { return *reinterpret_cast<const F*>(p); }
  static void store(float* p, F a) { *reinterpret_cast<F*>(p) = a; }
  static I load_int(const std::int32_t* p) { return *reinterpret_cast<const I*>(p); }
  static void store_int(std::int32_t* p, I a) { *reinterpret_cast<I*>(p) = a; }
  static F gather(const float* base, I i) { return F{base[i[0]], base[i[1]], base[i[2]], base[i[3]]}; }
  static I gather_int(const std::int32_t* base, I i) {
    return I{base[i[0]], base[i[1]], base[i[2]], base[i[3]]};
  }
  static void gather_pair(const std::int32_t* base, I i, I& first, I& second) {
    first = gather_int(base, i);
    second = gather_int(base + 1, i);
  }
  static F add(F a, F b) { return a + b; }
  static F sub(F a, F b) { return a - b; }
  static F mul(F a, F b) { return a * b; }
  static F div(F a, F b) { return a / b; }
  static F min(F a, F b) { return select(less(a, b), a, b); }
  static F max(F a, F b) { return select(less(b, a), a, b); }
  static F sqrt(F a) {
    return F{__builtin_sqrtf(a[0]), __builtin_sqrtf(a[1]), __builtin_sqrtf(a[2]), __builtin_sqrtf(a[3])};
  }
  static F abs(F a) { return float_of_bits(bits_of(a) & 0x7fffffff); }
  static M less(F a, F b) { return a < b; }
  static M less_equal(F a, F b) { return a <= b; }
  static I truncate(F a) { return __builtin_convertvector(a, I); }
  static F to_float(I a) { return __builtin_convertvector(a, F); }
  static I bits_of(F a) { return reinterpret_cast<I>(a); }
  static F float_of_bits(I a) { return reinterpret_cast<F>(a); }
  static I add_int(I a, I b) { return wrap(unsign(a) + unsign(b)); }
  static I sub_int(I a, I b) { return wrap(unsign(a) - unsign(b)); }
  static I mul_int(I a, I b) { return wrap(unsign(a) * unsign(b)); }
  static I xor_int(I a, I b) { return a ^ b; }
  static I or_int(I a, I b) { return a | b; }
  static I and_int(I a, I b) { return a & b; }
  template <int bits>
  static I shift_left(I a) {
    return wrap(unsign(a) << bits);
  }
  template <int bits>
  static I shift_right(I a) {
    return wrap(unsign(a) >> bits);
  }
  static F select(M m, F a, F b) { return float_of_bits((m & bits_of(a)) | (~m & bits_of(b))); }
  static I select_int(M m, I a, I b) { return (m & a) | (~m & b); }
  static M mask_and(M a, M b) { return a & b; }
  static M mask_or(M a, M b) { return a | b; }
  static M mask_and_not(M a, M b) { return a & ~b; }
  static std::uint32_t bits(M m) {
    return (m[0] ? 1u : 0u) | (m[1] ? 2u : 0u) | (m[2] ? 4u : 0u) | (m[3] ? 8u : 0u);
  }

 private:
  static U unsign(I a) { return reinterpret_cast<U>(a); }
  static I wrap(U a) { return reinterpret_cast<I>(a); }
};

}  // namespace
}  // namespace eigengrasp::kernel
