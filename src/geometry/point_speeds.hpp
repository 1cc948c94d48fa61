// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <algorithm>
#include <span>

#include "eigengrasp/geometry/mesh_motion.hpp"

namespace eigengrasp::detail {

struct CenteredBox {
  Vec3 center;
  Vec3 half;
};

inline CenteredBox centered(const Box& box) {
  return {box.center(), 0.5 * box.size()};
}

/// What the joints of one surface may do to its points, to first order.
class PointSpeeds {
 public:
  PointSpeeds(std::span<const Screw> joints, const Vec3& middle) : joints_(joints), middle_(middle) {
    for (const Screw& s : joints) {
      const Vec3 v = s.velocity(middle_);
      forward_ += v.cwiseMax(Vec3::Zero());
      backward_ += v.cwiseMin(Vec3::Zero());
      turning_ += s.angular.cwiseAbs();
      speed_ += v.norm();
      spin_ += s.angular.norm();
    }
  }

  bool still() const { return joints_.empty(); }

  /// Largest speed in a ball.
  double within(const Vec3& center, double radius) const {
    return still() ? 0.0 : speed_ + spin_ * ((center - middle_).norm() + radius);
  }

  /// Adds t times the ranges of velocity in a box, along each axis.
  void sweep(const CenteredBox& box, double t, Vec3& low, Vec3& high) const {
    if (still()) return;
    const Vec3 arm = (box.center - middle_).cwiseAbs() + box.half;
    const Vec3 turned(turning_.y() * arm.z() + turning_.z() * arm.y(),
                      turning_.z() * arm.x() + turning_.x() * arm.z(),
                      turning_.x() * arm.y() + turning_.y() * arm.x());
    low += t * (backward_ - turned);
    high += t * (forward_ + turned);
  }

  /// Largest speed of any corner along the direction n.
  double along(const TriangleCorners& t, const Vec3& n) const {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    for (const Screw& s : joints_) {
      const double still = n.dot(s.linear);
      const Vec3 m = n.cross(s.angular);  // n . (w x p) = (n x w) . p
      a += std::max(0.0, still + m.dot(t.a));
      b += std::max(0.0, still + m.dot(t.b));
      c += std::max(0.0, still + m.dot(t.c));
    }
    return std::max({a, b, c});
  }

 private:
  std::span<const Screw> joints_;
  Vec3 middle_;
  Vec3 forward_ = Vec3::Zero();   ///< velocity of the middle: of the joints that move it along each axis
  Vec3 backward_ = Vec3::Zero();  ///< and of those that move it against it
  Vec3 turning_ = Vec3::Zero();   ///< sums of the joints' angular speeds about each axis
  double speed_ = 0.0;            ///< of the middle
  double spin_ = 0.0;
};

}  // namespace eigengrasp::detail
