// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/render/camera.hpp"
#include "ray_scene.hpp"

namespace eigengrasp {

/// How much of the sky and of the key light a point sees, both in [0, 1].
struct Visibility {
  float ambient = 1.0F;
  float key = 1.0F;
};

/// Lights that stand with the camera, and the shading of a point by them. Linear light.
class Lighting {
 public:
  /// @param reach_m distance over which surfaces take ambient light from each other [m]
  Lighting(const Camera& camera, const Vec3& sky_W, double reach_m);

  /// Rays from a point into its hemisphere (ambient) and to the key light, by a pattern that differs between
  /// the pixels of a 4 x 4 block; then what they saw.
  Visibility sample(const RayScene& scene, const Vec3f& p_W, const SurfaceHit& hit, int x, int y) const;

  /// Light that leaves a surface of the given albedo towards the viewer.
  Vec3f shade(const Vec3f& albedo, const Vec3f& normal, const Vec3f& to_viewer, const Visibility& seen) const;

  /// The same for markers, which nothing shades.
  Vec3f shade_marker(const Vec3f& albedo, const Vec3f& normal, const Vec3f& to_viewer) const;

 private:
  Vec3f key_;   ///< unit, to the light
  Vec3f fill_;  ///< unit, to the light
  Vec3f sky_;   ///< unit, upwards
  std::array<Vec3f, 2> key_tangents_;
  float reach_;
};

}  // namespace eigengrasp
