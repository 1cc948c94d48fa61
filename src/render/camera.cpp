// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/render/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "eigengrasp/contact/contact_point.hpp"

namespace eigengrasp {

namespace {

/// Bounds of the points in the camera's axes: largest of +-x - t z and +-y - t z, z the depth.
struct Extent {
  double positive = -std::numeric_limits<double>::infinity();
  double negative = -std::numeric_limits<double>::infinity();
  void add(double offset, double slope_depth) {
    positive = std::max(positive, offset - slope_depth);
    negative = std::max(negative, -offset - slope_depth);
  }
};

}  // namespace

Vec3 Camera::ray_direction(double u, double v) const {
  const double t = std::tan(0.5 * fov);
  return forward + u * t * aspect * right() + v * t * up;
}

Vec3 Camera::project(const Vec3& p_W) const {
  const Vec3 d = p_W - position;
  const double depth = d.dot(forward);
  const double t = std::tan(0.5 * fov);
  return {d.dot(right()) / (depth * t * aspect), d.dot(up) / (depth * t), depth};
}

Camera frame_camera(std::span<const Vec3> points_W, const Vec3& direction, const Vec3& up, double fov,
                    double aspect, double margin) {
  if (points_W.empty()) throw std::logic_error("frame_camera: no points");
  Camera camera;
  camera.fov = fov;
  camera.aspect = aspect;
  camera.forward = direction.normalized();
  const Vec3 level = up - up.dot(camera.forward) * camera.forward;
  camera.up = level.norm() > 1e-6 * up.norm() ? level.normalized() : contact_tangents(camera.forward)[0];

  // |x - cx| <= tx (z + d) and |y - cy| <= ty (z + d) for all points, with the least distance d.
  const double ty = std::tan(0.5 * fov) * (1.0 - margin);
  const double tx = ty * aspect;
  const Vec3 right = camera.right();
  Extent horizontal;
  Extent vertical;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points_W) {
    const double z = p.dot(camera.forward);
    horizontal.add(p.dot(right), tx * z);
    vertical.add(p.dot(camera.up), ty * z);
    nearest = std::min(nearest, z);
  }
  const double cx = 0.5 * (horizontal.positive - horizontal.negative);
  const double cy = 0.5 * (vertical.positive - vertical.negative);
  const double d = std::max({(horizontal.positive + horizontal.negative) / (2.0 * tx),
                             (vertical.positive + vertical.negative) / (2.0 * ty), 1e-6 - nearest});
  camera.position = cx * right + cy * camera.up - d * camera.forward;
  return camera;
}

Camera frame_camera(const Box& box_W, const Vec3& direction, const Vec3& up, double fov, double aspect,
                    double margin) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] =
        Vec3((i & 1) != 0 ? box_W.max.x() : box_W.min.x(), (i & 2) != 0 ? box_W.max.y() : box_W.min.y(),
             (i & 4) != 0 ? box_W.max.z() : box_W.min.z());
  return frame_camera(std::span<const Vec3>(corners), direction, up, fov, aspect, margin);
}

std::vector<Vec3> view_candidates(const Vec3& up) {
  const Vec3 u = up.normalized();
  const auto [t1, t2] = contact_tangents(u);
  std::vector<Vec3> directions;
  for (const double degrees : {18.0, 42.0}) {
    const double elevation = degrees * std::numbers::pi / 180.0;
    for (int i = 0; i < 8; ++i) {
      const double azimuth = (i + (degrees > 30.0 ? 0.5 : 0.0)) * std::numbers::pi / 4.0;
      const Vec3 sideways = std::cos(azimuth) * t1 + std::sin(azimuth) * t2;
      directions.emplace_back(-(std::cos(elevation) * sideways + std::sin(elevation) * u));
    }
  }
  directions.emplace_back((-0.97 * u - 0.24 * t1).normalized());
  return directions;
}

}  // namespace eigengrasp
