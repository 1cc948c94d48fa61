// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "planning/kernel/vectors.hpp"

/// Drawing neighbours of sixteen states: random numbers, the jumps of Ingber's annealing, thresholds of
/// acceptance.
namespace eigengrasp::kernel {

/// Of x in [-80, 80], to 2e-7. 2^n times a Taylor polynomial of the rest.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> exponential(const Floats<B>& x) {
  using F = Floats<B>;
  const F halves = x * F(1.44269504f);
  const Ints<B> n = truncate(halves + select(halves < F(0.0f), F(-0.5f), F(0.5f)));
  const F k = to_float(n);
  const F r = (x - k * F(0.693359375f)) + k * F(2.12194440e-4f);
  const F poly =
      F(1.0f) +
      r * (F(1.0f) +
           r * (F(0.5f) + r * (F(1.6666667e-1f) +
                               r * (F(4.1666667e-2f) + r * (F(8.3333333e-3f) + r * F(1.3888889e-3f))))));
  return poly * float_of_bits(shift_left<23>(n + Ints<B>(127)));
}

/// Natural logarithm of x > 0, not denormal, to 2e-7: exponent, and the series of the area tangent of the
/// rest.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> logarithm(const Floats<B>& x) {
  using F = Floats<B>;
  const Ints<B> raw = bits_of(x);
  const Ints<B> e = shift_right<23>(raw - Ints<B>(0x3f3504f3));  // x = 2^e m, m from sqrt(1/2) to sqrt(2)
  const Ints<B> exponent = select(F(0.70710678f) <= x, e, e - Ints<B>(512));  // the shift was logical
  const F m = float_of_bits(raw - shift_left<23>(exponent));
  const F s = (m - F(1.0f)) / (m + F(1.0f));
  const F s2 = s * s;
  const F series = F(2.0f) * s *
                   (F(1.0f) + s2 * (F(3.3333333e-1f) +
                                    s2 * (F(2.0e-1f) + s2 * (F(1.4285714e-1f) + s2 * F(1.1111111e-1f)))));
  return series + to_float(exponent) * F(0.69314718f);
}

/// Sixteen streams of random numbers: xoshiro128++ (Blackman and Vigna 2019).
template <class B>
class LaneRandom {
 public:
  EIGENGRASP_LANES_INLINE explicit LaneRandom(std::int32_t* state) : memory_(state) {
    for (int i = 0; i < 4; ++i) s_[i] = load_ints<B>(state + i * n_lanes);
  }
  EIGENGRASP_LANES_INLINE void save() const {
    for (int i = 0; i < 4; ++i) store_ints<B>(memory_ + i * n_lanes, s_[i]);
  }
  /// In (0, 1), 23 bits: the middles of 2^23 equal parts.
  EIGENGRASP_LANES_INLINE Floats<B> uniform() {
    const Ints<B> sum = s_[0] + s_[3];
    const Ints<B> result = rotate<7>(sum) + s_[0];
    const Ints<B> t = shift_left<9>(s_[1]);
    s_[2] = s_[2] ^ s_[0];
    s_[3] = s_[3] ^ s_[1];
    s_[1] = s_[1] ^ s_[2];
    s_[0] = s_[0] ^ s_[3];
    s_[2] = s_[2] ^ t;
    s_[3] = rotate<11>(s_[3]);
    return (to_float(shift_right<9>(result)) + Floats<B>(0.5f)) * Floats<B>(0x1.0p-23f);
  }

 private:
  template <int k>
  EIGENGRASP_LANES_INLINE static Ints<B> rotate(const Ints<B>& x) {
    return shift_left<k>(x) | shift_right<32 - k>(x);
  }
  std::int32_t* memory_;
  Ints<B> s_[4];
};

template <class B>
class Proposal {
  using F = Floats<B>;

 public:
  EIGENGRASP_LANES_INLINE Proposal(const SearchBox& box, const Chains& chains, const Workspace& work)
      : box_(box),
        chains_(chains),
        work_(work),
        random_(chains.random),
        temperature_(load<B>(chains.jump_temperature)),
        log_range_(load<B>(chains.log_range)) {}

  void run() {
    for (int i = 0; i < 3; ++i)
      shift(chains_.position + i * n_lanes, box_.max_shift, box_.low[i], box_.high[i],
            work_.position + i * n_lanes);
    turn();
    for (int i = 0; i < box_.n_amplitudes; ++i) {
      const Range& a = box_.amplitudes[i];
      shift(chains_.amplitudes + i * n_lanes, a.max_jump, a.low, a.high, work_.amplitudes + i * n_lanes);
    }
    // Metropolis: a state is taken where u < exp(-(E - E_now) / T), that is E < E_now - T ln u.
    const F u = random_.uniform();
    store<B>(work_.threshold,
             load<B>(chains_.energy) - load<B>(chains_.acceptance_temperature) * logarithm<B>(u));
    random_.save();
  }

 private:
  /// y = sign T ((1 + 1/T)^|2u - 1| - 1), in (-1, 1).
  EIGENGRASP_LANES_INLINE F jump() {
    const F v = F(2.0f) * random_.uniform() - F(1.0f);
    const F y = temperature_ * (exponential<B>(abs(v) * log_range_) - F(1.0f));
    return select(v < F(0.0f), F(0.0f) - y, y);
  }

  /// A jump beyond the range is drawn again, some times; then the value stays.
  EIGENGRASP_LANES_INLINE void shift(const float* from, float max_jump, float low, float high, float* to) {
    const F value = load<B>(from);
    F moved = value + F(max_jump) * jump();
    for (int attempt = 0; attempt < 6; ++attempt) {
      const Mask<B> outside = (moved < F(low)) | (F(high) < moved);
      if (bits(outside) == 0) break;
      moved = select(outside, value + F(max_jump) * jump(), moved);
    }
    const Mask<B> outside = (moved < F(low)) | (F(high) < moved);
    store<B>(to, select(outside, value, moved));
  }

  /// Turns by a rotation vector with three jumps for components.
  EIGENGRASP_LANES_INLINE void turn() {
    const F half = F(0.5f) * F(box_.max_turn);
    const Vector<B> h{half * jump(), half * jump(), half * jump()};
    const F angle = sqrt(max(dot(h, h), F(1e-30f)));
    const SineCosine<B> t = sine_cosine<B>(angle);
    const Vector<B> v = (t.sine / angle) * h;
    const F w0 = load<B>(chains_.quaternion);
    const Vector<B> v0{load<B>(chains_.quaternion + n_lanes), load<B>(chains_.quaternion + 2 * n_lanes),
                       load<B>(chains_.quaternion + 3 * n_lanes)};
    const F w = w0 * t.cosine - dot(v0, v);
    const Vector<B> cross{v0.y * v.z - v0.z * v.y, v0.z * v.x - v0.x * v.z, v0.x * v.y - v0.y * v.x};
    const Vector<B> r = w0 * v + t.cosine * v0 + cross;
    const F unit = F(1.0f) / sqrt(w * w + dot(r, r));
    store<B>(work_.quaternion, unit * w);
    store<B>(work_.quaternion + n_lanes, unit * r.x);
    store<B>(work_.quaternion + 2 * n_lanes, unit * r.y);
    store<B>(work_.quaternion + 3 * n_lanes, unit * r.z);
  }

  const SearchBox& box_;
  const Chains& chains_;
  const Workspace& work_;
  LaneRandom<B> random_;
  F temperature_;
  F log_range_;
};

template <class B>
void propose(const SearchBox& box, const Chains& chains, const Workspace& work) {
  Proposal<B>(box, chains, work).run();
}

}  // namespace eigengrasp::kernel
