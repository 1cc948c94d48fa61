// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "eigengrasp/render/render_scene.hpp"

namespace eigengrasp {

using Vec3f = Eigen::Vector3f;

struct SceneReleaser {
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};
using ScenePtr = std::unique_ptr<RTCSceneTy, SceneReleaser>;

/// The ray tracing device of the process, made at first use and never released.
RTCDevice ray_device();

/// Throws std::runtime_error with the device's last error, if there is one.
void check_ray_device();

class Surface {
 public:
  Surface(const TriangleMesh& mesh, double crease_angle);

  RTCScene rays() const { return rays_.get(); }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  /// Interpolated normal at barycentric (u, v) of a triangle; not normalised.
  Vec3f normal(unsigned triangle, float u, float v) const {
    const std::array<Vec3f, 3>& n = normals_[triangle];
    return (1.0F - u - v) * n[0] + u * n[1] + v * n[2];
  }

 private:
  std::vector<Vec3> vertices_;
  std::vector<std::array<Vec3f, 3>> normals_;  ///< of each triangle's corners
  ScenePtr rays_;
};

/// Unit normals of the corners of a welded mesh.
std::vector<std::array<Vec3f, 3>> corner_normals(const TriangleMesh& mesh, double crease_angle);

/// Meshes of the markers: a ball of radius 1; a cone with its apex at the origin, axis z, height 1 and base
/// radius 1 (closed); a cylinder of radius 1 from z = 0 to 1 (closed).
TriangleMesh unit_ball();
TriangleMesh unit_cone();
TriangleMesh unit_cylinder();

}  // namespace eigengrasp
