// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>
#include <vector>

#include "eigengrasp/geometry/mesh_motion.hpp"
#include "geometry/oriented_boxes.hpp"

namespace eigengrasp::detail {

inline Float4 larger(Float4 a, Float4 b) {
  return a > b ? a : b;
}
inline Float4 smaller(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline float radius_of(const TurnedBox& box) {
  const Float4 squares = box.half * box.half;
  return 1.000001f * std::sqrt(squares[0] + squares[1] + squares[2]);
}

/// Components of a vector along the axes of a box.
inline Float4 components(const TurnedBox& box, Float4 v) {
  return spread<0>(v) * box.rows[0] + spread<1>(v) * box.rows[1] + spread<2>(v) * box.rows[2];
}

/// Not less than the root of 1 - c^2, for cosines c: tangents of the root.
inline Float4 sine_bound(Float4 c) {
  const Float4 square = larger(1.000001f - c * c, Float4{});
  return smaller(smaller(0.5f + 0.5f * square, 1.0f / 6.0f + 1.5f * square), 0.05001f + 5.0f * square);
}

/// Pairs of boxes of two moving surfaces, in single precision: oriented boxes are larger than what they hold
/// by more than its rounding.
class MovingBoxes {
 public:
  MovingBoxes(const MovingBoxes&) = delete;
  MovingBoxes& operator=(const MovingBoxes&) = delete;
  explicit MovingBoxes(const SurfaceMotion& motion) {
    add_packs(motion.of_a);
    n_of_a_ = n_;
    add_packs(motion.of_b);
  }

  /// Gap of two boxes and the time [s] for which some axis shows them to stay farther apart than the margin.
  struct Outlook {
    float gap;
    double time;
  };
  Outlook look(const TurnedBox& a, const TurnedBox& b, double margin, double acceleration) const {
    const Gaps gaps(a, b);
    const float gap = gaps.largest();
    if (gap <= static_cast<float>(margin)) return {gap, 0.0};
    Axis axes[6];
    const int n = closing_axes(a, b, gaps, static_cast<float>(margin), axes);
    double time = 0.0;
    for (int i = 0; i < n; ++i) {
      const double free = axes[i].gap - margin;
      const double rate = 1.00001 * axes[i].rate();
      if (free > time * (rate + 0.5 * acceleration * time))
        time = std::max(time, time_to_close(free, rate, acceleration));
    }
    return {gap, time};
  }

 private:
  /// Vectors between the boxes and their gaps along the axes of both.
  struct Gaps {
    Gaps(const TurnedBox& a, const TurnedBox& b)
        : along_a(components(a, b.center - a.center)),
          along_b(components(b, b.center - a.center)),
          of_a(magnitude(along_a) - a.half - extent_along(a, b)),
          of_b(magnitude(along_b) - b.half - extent_along(b, a)) {}
    float largest() const { return detail::largest(larger(of_a, of_b)); }
    Float4 along_a;
    Float4 along_b;
    Float4 of_a;
    Float4 of_b;
  };

  /// Four joints of one surface.
  struct Pack {
    Float4 angular[3];
    Float4 linear[3];
    Float4 axis[3];
    Float4 spin;
  };

  /// Direction from b to a, the gap along it, and how fast it can close at first, by joints.
  struct Axis {
    Float4 n[3];
    float gap;
    Float4 rates{};
    float rate() const { return rates[0] + rates[1] + rates[2] + rates[3]; }
  };

  void add_packs(std::span<const Screw> joints) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (j % 4 == 0) add_pack();
      Pack& pack = packs_[n_ - 1];
      const Screw& s = joints[j];
      const double spin = s.angular.norm();
      for (int k = 0; k < 3; ++k) {
        pack.angular[k][j % 4] = static_cast<float>(s.angular[k]);
        pack.linear[k][j % 4] = static_cast<float>(s.linear[k]);
        pack.axis[k][j % 4] = spin > 0.0 ? static_cast<float>(s.angular[k] / spin) : 0.0f;
      }
      pack.spin[j % 4] = static_cast<float>(spin);
    }
  }

  void add_pack() {
    if (n_ == few) many_.assign(packs_, packs_ + n_);
    if (n_ >= few) {
      many_.emplace_back();
      packs_ = many_.data();
    } else {
      packs_[n_] = Pack{};
    }
    ++n_;
  }

  /// The axes along which the gap is larger than the reserve.
  int closing_axes(const TurnedBox& a, const TurnedBox& b, const Gaps& gaps, float reserve,
                   Axis* axes) const {
    int n = 0;
    const auto add = [&](const TurnedBox& box, int k, float gap, float along) {
      if (gap <= reserve) return;
      const float side = along > 0.0f ? -1.0f : 1.0f;
      for (int r = 0; r < 3; ++r) axes[n].n[r] = Float4{} + side * box.rows[r][k];
      axes[n++].gap = gap;
    };
    for (int k = 0; k < 3; ++k) {
      add(a, k, gaps.of_a[k], gaps.along_a[k]);
      add(b, k, gaps.of_b[k], gaps.along_b[k]);
    }
    if (n > 0) {
      for (std::size_t p = 0; p < n_of_a_; ++p) add_rates(packs_[p], a, -1.0f, axes, n);
      for (std::size_t p = n_of_a_; p < n_; ++p) add_rates(packs_[p], b, 1.0f, axes, n);
    }
    return n;
  }

  static void add_rates(const Pack& pack, const TurnedBox& box, float side, Axis* axes, int n) {
    const Float4 x = spread<0>(box.center);
    const Float4 y = spread<1>(box.center);
    const Float4 z = spread<2>(box.center);
    const Float4* w = pack.angular;
    const Float4 vx = side * (pack.linear[0] + w[1] * z - w[2] * y);
    const Float4 vy = side * (pack.linear[1] + w[2] * x - w[0] * z);
    const Float4 vz = side * (pack.linear[2] + w[0] * y - w[1] * x);
    const Float4 turn = pack.spin * radius_of(box);
    for (int i = 0; i < n; ++i) {
      const Float4* d = axes[i].n;
      const Float4 cosine = d[0] * pack.axis[0] + d[1] * pack.axis[1] + d[2] * pack.axis[2];
      axes[i].rates += larger(d[0] * vx + d[1] * vy + d[2] * vz + turn * sine_bound(cosine), Float4{});
    }
  }

  static constexpr std::size_t few = 6;
  Pack few_[few];
  std::vector<Pack> many_;  ///< only where there are more
  Pack* packs_ = few_;      ///< those of a first
  std::size_t n_ = 0;
  std::size_t n_of_a_ = 0;
};

}  // namespace eigengrasp::detail
