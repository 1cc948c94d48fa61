// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <immintrin.h>

#include "core/lanes.hpp"

namespace eigengrasp::kernel {
namespace {

/// One register of AVX-512 (F and DQ). @pre the processor has both
struct Avx512 {
  static constexpr int width = 16;
  using F = __m512;
  using I = __m512i;
  using M = __mmask16;
  static F set1(float x) { return _mm512_set1_ps(x); }
  static I set1_int(std::int32_t x) { return _mm512_set1_epi32(x); }
  static F load(const float* p) { return _mm512_load_ps(p); }
  static void store(float* p, F a) { _mm512_store_ps(p, a); }
  static I load_int(const std::int32_t* p) { return _mm512_load_si512(p); }
  static void store_int(std::int32_t* p, I a) { _mm512_store_si512(p, a); }
  static F gather(const float* base, I index) { return _mm512_i32gather_ps(index, base, 4); }
  static I gather_int(const std::int32_t* base, I index) { return _mm512_i32gather_epi32(index, base, 4); }
  static void gather_pair(const std::int32_t* base, I index, I& first, I& second) {  // eight bytes at a time
    const I even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const I odd = _mm512_or_si512(even, _mm512_set1_epi32(1));
    const I a = _mm512_i32gather_epi64(_mm512_castsi512_si256(index), base, 4);
    const I b = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(index, 1), base, 4);
    first = _mm512_permutex2var_epi32(a, even, b);
    second = _mm512_permutex2var_epi32(a, odd, b);
  }
  static F add(F a, F b) { return _mm512_add_ps(a, b); }
  static F sub(F a, F b) { return _mm512_sub_ps(a, b); }
  static F mul(F a, F b) { return _mm512_mul_ps(a, b); }
  static F div(F a, F b) { return _mm512_div_ps(a, b); }
  static F min(F a, F b) { return _mm512_min_ps(a, b); }
  static F max(F a, F b) { return _mm512_max_ps(a, b); }
  static F sqrt(F a) { return _mm512_sqrt_ps(a); }
  static F abs(F a) { return _mm512_abs_ps(a); }
  static M less(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static M less_equal(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static I truncate(F a) { return _mm512_cvttps_epi32(a); }
  static F to_float(I a) { return _mm512_cvtepi32_ps(a); }
  static I bits_of(F a) { return _mm512_castps_si512(a); }
  static F float_of_bits(I a) { return _mm512_castsi512_ps(a); }
  static I add_int(I a, I b) { return _mm512_add_epi32(a, b); }
  static I sub_int(I a, I b) { return _mm512_sub_epi32(a, b); }
  static I mul_int(I a, I b) { return _mm512_mullo_epi32(a, b); }
  static I xor_int(I a, I b) { return _mm512_xor_si512(a, b); }
  static I or_int(I a, I b) { return _mm512_or_si512(a, b); }
  static I and_int(I a, I b) { return _mm512_and_si512(a, b); }
  template <int bits>
  static I shift_left(I a) {
    return _mm512_slli_epi32(a, bits);
  }
  template <int bits>
  static I shift_right(I a) {
    return _mm512_srli_epi32(a, bits);
  }
  static F select(M m, F a, F b) { return _mm512_mask_blend_ps(m, b, a); }
  static I select_int(M m, I a, I b) { return _mm512_mask_blend_epi32(m, b, a); }
  static M mask_and(M a, M b) { return static_cast<M>(a & b); }
  static M mask_or(M a, M b) { return static_cast<M>(a | b); }
  static M mask_and_not(M a, M b) { return static_cast<M>(a & ~b); }
  static std::uint32_t bits(M m) { return m; }
};

}  // namespace
}  // namespace eigengrasp::kernel
