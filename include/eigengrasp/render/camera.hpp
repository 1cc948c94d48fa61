// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "eigengrasp/core/pose.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// A pinhole camera in the world frame W, the picture's centre on its axis. Axes: x right, y up, -z into the
/// picture.
struct Camera {
  Vec3 position = Vec3::UnitX();
  Vec3 forward = -Vec3::UnitX();  ///< unit, into the picture
  Vec3 up = Vec3::UnitZ();        ///< unit, orthogonal to forward
  double fov = 0.4;               ///< full vertical angle [rad], in (0, pi)
  double aspect = 1.0;            ///< width / height

  Vec3 right() const { return forward.cross(up); }
  /// Unnormalised direction of the ray through the picture point (u, v), u to the right, v upwards, the frame
  /// being [-1, 1] x [-1, 1].
  Vec3 ray_direction(double u, double v) const;
  /// Picture point (u, v) of p and, third, its depth along forward [m].
  Vec3 project(const Vec3& p_W) const;
};

inline constexpr double kDefaultFov = 25.0 * std::numbers::pi / 180.0;

/// The nearest camera looking along `direction` that has all points in its frame; points then touch two
/// opposite sides of the frame, or all four. `up` is made orthogonal to the direction (any orthogonal one
/// where it is parallel to it).
/// @param margin share of the half picture that stays free, in [0, 1)
/// @pre at least one point, direction not zero, 0 < fov < pi, aspect > 0
Camera frame_camera(std::span<const Vec3> points_W, const Vec3& direction, const Vec3& up,
                    double fov = kDefaultFov, double aspect = 1.0, double margin = 0.0);

/// The same for the corners of a box.
Camera frame_camera(const Box& box_W, const Vec3& direction, const Vec3& up, double fov = kDefaultFov,
                    double aspect = 1.0, double margin = 0.0);

/// Directions (unit, into the scene) from which one may look: 8 around the up axis at each of two elevations
/// and one steeply from above; 17 in all.
std::vector<Vec3> view_candidates(const Vec3& up);

}  // namespace eigengrasp
