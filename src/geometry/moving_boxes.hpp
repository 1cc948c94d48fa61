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

inline Float4 cross(Float4 a, Float4 b) {
  const Float4 c =
      a * __builtin_shufflevector(b, b, 1, 2, 0, 3) - __builtin_shufflevector(a, a, 1, 2, 0, 3) * b;
  return __builtin_shufflevector(c, c, 1, 2, 0, 3);
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
  explicit MovingBoxes(const SurfaceMotion& motion) : n_of_a_(motion.of_a.size()) {
    joints_.reserve(motion.of_a.size() + motion.of_b.size());
    for (const Screw& s : motion.of_a) joints_.emplace_back(s);
    for (const Screw& s : motion.of_b) joints_.emplace_back(s);
  }

  /// Gap of two boxes and how they stand to a motion of `time` in which they may come nearer by `reserve`
  /// besides: apart all the while, as some axis of one of them shows, or not surely.
  struct Outlook {
    float gap;
    bool apart;
  };
  Outlook look(const TurnedBox& a, const TurnedBox& b, float time, float reserve) const {
    const Float4 d = b.center - a.center;
    const Float4 along_a = components(a, d);
    const Float4 along_b = components(b, d);
    const Float4 gap_a = magnitude(along_a) - a.half - extent_along(a, b);
    const Float4 gap_b = magnitude(along_b) - b.half - extent_along(b, a);
    const float gap = largest(larger(gap_a, gap_b));
    if (gap <= reserve) return {gap, false};
    Float4 rate_a{};
    Float4 rate_b{};
    const Float4 towards_a = along_a > 0.0f ? Float4{} - 1.0f : Float4{} + 1.0f;
    const Float4 towards_b = along_b > 0.0f ? Float4{} - 1.0f : Float4{} + 1.0f;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const bool of_a = k < n_of_a_;
      const Joint& joint = joints_[k];
      const Float4 v = joint.linear + cross(joint.angular, of_a ? a.center : b.center);
      const Float4 velocity = of_a ? -v : v;
      const float turn = joint.spin * radius_of(of_a ? a : b);
      rate_a += larger(towards_a * components(a, velocity) + turn * sine_bound(components(a, joint.axis)),
                       Float4{});
      rate_b += larger(towards_b * components(b, velocity) + turn * sine_bound(components(b, joint.axis)),
                       Float4{});
    }
    const float motion = 1.00001f * time;
    return {gap, largest(larger(gap_a - motion * rate_a, gap_b - motion * rate_b)) > reserve};
  }

 private:
  struct Joint {
    explicit Joint(const Screw& s)
        : angular(to_floats(s.angular)),
          linear(to_floats(s.linear)),
          spin(static_cast<float>(s.angular.norm())),
          axis(spin > 0.0f ? to_floats(s.angular / s.angular.norm()) : Float4{}) {}
    static Float4 to_floats(const Vec3& v) {
      return Float4{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0.0f};
    }
    Float4 angular;
    Float4 linear;
    float spin;
    Float4 axis;
  };
  std::vector<Joint> joints_;  ///< those of a first
  std::size_t n_of_a_;
};

}  // namespace eigengrasp::detail
