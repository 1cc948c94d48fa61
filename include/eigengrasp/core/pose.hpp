// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace eigengrasp {

/// Three numbers: a point [m], a direction [-], a force [N] or a torque [N m], as the name of the variable
/// says.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using VecX = Eigen::VectorXd;
/// Force first, then torque: (fx, fy, fz, tx, ty, tz).
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Rigid motion. Named in monogram notation: X_OH is the pose of frame H in frame O, so X_OH * p_HC = p_OC.
using Pose = Eigen::Isometry3d;

/// The rigid motion that first turns by q_AB (need not be normalised, must not be zero), then shifts by p_AB
/// [m].
inline Pose make_pose(const Eigen::Quaterniond& q_AB, const Vec3& p_AB) {
  Pose X_AB = Pose::Identity();
  X_AB.linear() = q_AB.normalized().toRotationMatrix();
  X_AB.translation() = p_AB;
  return X_AB;
}

/// The orientation of a pose as a unit quaternion with w >= 0.
inline Eigen::Quaterniond orientation(const Pose& X_AB) {
  Eigen::Quaterniond q(X_AB.linear());
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

/// The pose at a share of the way between two: straight, turning at one rate. @param share in [0, 1]
inline Pose interpolate(const Pose& X_a, const Pose& X_b, double share) {
  return make_pose(orientation(X_a).slerp(share, orientation(X_b)),
                   (1.0 - share) * X_a.translation() + share * X_b.translation());
}

/// Angle [rad] in [0, pi] of the rotation that separates two orientations.
inline double angle_between(const Mat3& R_a, const Mat3& R_b) {
  const double c = 0.5 * ((R_a.transpose() * R_b).trace() - 1.0);
  return std::acos(std::min(1.0, std::max(-1.0, c)));
}

}  // namespace eigengrasp
