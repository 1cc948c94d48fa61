// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <immintrin.h>

#include "core/lanes.hpp"

namespace eigengrasp::kernel {
namespace {

/// Two registers of AVX2. @pre the processor has it
struct Avx2 {
  static constexpr int width = 8;
  using F = __m256;
  using I = __m256i;
  using M = __m256;
  static F set1(float x) { return _mm256_set1_ps(x); }
  static I set1_int(std::int32_t x) { return _mm256_set1_epi32(x); }
  static F load(const float* p) { return _mm256_load_ps(p); }
  static void store(float* p, F a) { _mm256_store_ps(p, a); }
  static I load_int(const std::int32_t* p) { return _mm256_load_si256(reinterpret_cast<const I*>(p)); }
  static void store_int(std::int32_t* p, I a) { _mm256_store_si256(reinterpret_cast<I*>(p), a); }
  static F gather(const float* base, I index) { return _mm256_i32gather_ps(base, index, 4); }
  static I gather_int(const std::int32_t* base, I index) { return _mm256_i32gather_epi32(base, index, 4); }
  static void gather_pair(const std::int32_t* base, I index, I& first, I& second) {  // eight bytes at a time
    const auto* const pairs = reinterpret_cast<const double*>(base);
    const F a = _mm256_castpd_ps(_mm256_i32gather_pd(pairs, _mm256_castsi256_si128(index), 4));
    const F b = _mm256_castpd_ps(_mm256_i32gather_pd(pairs, _mm256_extracti128_si256(index, 1), 4));
    first = bits_of(in_order(_mm256_shuffle_ps(a, b, 0x88)));
    second = bits_of(in_order(_mm256_shuffle_ps(a, b, 0xdd)));
  }
  static F add(F a, F b) { return _mm256_add_ps(a, b); }
  static F sub(F a, F b) { return _mm256_sub_ps(a, b); }
  static F mul(F a, F b) { return _mm256_mul_ps(a, b); }
  static F div(F a, F b) { return _mm256_div_ps(a, b); }
  static F min(F a, F b) { return _mm256_min_ps(a, b); }
  static F max(F a, F b) { return _mm256_max_ps(a, b); }
  static F sqrt(F a) { return _mm256_sqrt_ps(a); }
  static F abs(F a) { return _mm256_and_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(0x7fffffff))); }
  static M less(F a, F b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static M less_equal(F a, F b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
  static I truncate(F a) { return _mm256_cvttps_epi32(a); }
  static F to_float(I a) { return _mm256_cvtepi32_ps(a); }
  static I bits_of(F a) { return _mm256_castps_si256(a); }
  static F float_of_bits(I a) { return _mm256_castsi256_ps(a); }
  static I add_int(I a, I b) { return _mm256_add_epi32(a, b); }
  static I sub_int(I a, I b) { return _mm256_sub_epi32(a, b); }
  static I mul_int(I a, I b) { return _mm256_mullo_epi32(a, b); }
  static I xor_int(I a, I b) { return _mm256_xor_si256(a, b); }
  static I or_int(I a, I b) { return _mm256_or_si256(a, b); }
  static I and_int(I a, I b) { return _mm256_and_si256(a, b); }
  template <int bits>
  static I shift_left(I a) {
    return _mm256_slli_epi32(a, bits);
  }
  template <int bits>
  static I shift_right(I a) {
    return _mm256_srli_epi32(a, bits);
  }
  static F select(M m, F a, F b) { return _mm256_blendv_ps(b, a, m); }
  static I select_int(M m, I a, I b) { return _mm256_blendv_epi8(b, a, _mm256_castps_si256(m)); }
  static M mask_and(M a, M b) { return _mm256_and_ps(a, b); }
  static M mask_or(M a, M b) { return _mm256_or_ps(a, b); }
  static M mask_and_not(M a, M b) { return _mm256_andnot_ps(b, a); }
  static std::uint32_t bits(M m) { return static_cast<std::uint32_t>(_mm256_movemask_ps(m)); }

 private:
  static F in_order(F a) { return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(a), 0xd8)); }
};

}  // namespace
}  // namespace eigengrasp::kernel
