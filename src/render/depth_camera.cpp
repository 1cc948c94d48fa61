// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/render/depth_camera.hpp"

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/render/render_scene.hpp"
#include "render/ray_scene.hpp"

namespace eigengrasp {

PointCloud take_depth_view(const TriangleMesh& mesh, const DepthCamera& depth_camera, std::uint64_t seed) {
  RenderScene scene;
  scene.add(mesh, Pose::Identity(), Color{});
  const RayScene rays_of(scene);
  const Camera& camera = depth_camera.camera;
  PointCloud cloud;
  cloud.viewpoint = camera.position;
  RandomStream random({seed, 0x64657074ULL});
  const int pixels = depth_camera.columns * depth_camera.rows;
  for (int first = 0; first < pixels; first += kLanes) {
    Rays rays;
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      const int pixel = first + lane;
      rays.active[l] = pixel < pixels;
      if (!rays.active[l]) continue;
      const int column = pixel % depth_camera.columns, row = pixel / depth_camera.columns;
      const double u = 2.0 * (column + 0.5) / depth_camera.columns - 1.0;
      const double v = 1.0 - 2.0 * (row + 0.5) / depth_camera.rows;
      rays.origins[l] = camera.position.cast<float>();
      rays.directions[l] = camera.ray_direction(u, v).normalized().cast<float>();
    }
    std::array<SurfaceHit, kLanes> hits;
    rays_of.trace_solids(rays, hits);
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double noise = random.normal();
      if (!rays.active[l] || hits[l].item < 0) continue;
      const Vec3 direction = rays.directions[l].cast<double>();
      if (std::abs(direction.dot(hits[l].geometric.cast<double>())) < depth_camera.least_cosine) continue;
      const auto distance = static_cast<double>(hits[l].distance);
      cloud.points.push_back(camera.position +
                             (distance + noise * depth_camera.noise * distance * distance) * direction);
    }
  }
  return cloud;
}

}  // namespace eigengrasp
