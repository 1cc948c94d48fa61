// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/mesh_motion.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp::testing {

inline Pose turned_about(const Vec3& axis, const Vec3& through, double angle) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  X.translation() = through - X.linear() * through;
  return X;
}

/// A chain of two joints that moves a surface: the outer one is carried along by the inner one.
struct Chain {
  Vec3 axes[2];
  Vec3 points[2];
  double rates[2];

  Pose at(double t, double t_outer) const {
    return turned_about(axes[0], points[0], rates[0] * t) *
           turned_about(axes[1], points[1], rates[1] * t_outer);
  }
  std::vector<Screw> screws() const {
    std::vector<Screw> result;
    for (int j = 0; j < 2; ++j) {
      const Vec3 w = rates[j] * axes[j];
      result.push_back({w, points[j].cross(w)});
    }
    return result;
  }
  /// Bound for points within `reach` of both joints.
  double acceleration(double reach) const {
    const double a = std::abs(rates[0]);
    const double b = std::abs(rates[1]);
    return reach * (a * a + b * (b + 2.0 * a));
  }
};

inline Chain any_chain(RandomStream& random, const Box& box) {
  Chain chain;
  for (int j = 0; j < 2; ++j) {
    chain.axes[j] = random_direction(random);
    chain.points[j] = any_point(random, box, 0.05);
    chain.rates[j] = random.uniform(-1.0, 1.0);
  }
  return chain;
}

}  // namespace eigengrasp::testing
