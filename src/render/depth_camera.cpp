// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/render/depth_camera.hpp"

#include <algorithm>
#include <cmath>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/render/render_scene.hpp"
#include "render/ray_scene.hpp"

namespace eigengrasp {

namespace {

RenderScene scene_of(const TriangleMesh& mesh) {
  RenderScene scene;
  scene.add(mesh, Pose::Identity(), Color{});
  return scene;
}

/// What a camera sees, pixel by pixel, row by row from above.
struct DepthPicture {
  std::vector<Vec3> directions;   ///< unit
  std::vector<double> distances;  ///< from the camera [m]; 0: nothing
};

DepthPicture take_picture(const RayScene& rays_of, const DepthCamera& depth_camera) {
  const Camera& camera = depth_camera.camera;
  const int pixels = depth_camera.columns * depth_camera.rows;
  DepthPicture picture;
  picture.directions.resize(static_cast<std::size_t>(pixels));
  picture.distances.resize(static_cast<std::size_t>(pixels), 0.0);
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
      if (!rays.active[l]) continue;
      const auto pixel = static_cast<std::size_t>(first) + l;
      const Vec3 direction = rays.directions[l].cast<double>();
      picture.directions[pixel] = direction;
      if (hits[l].item < 0) continue;
      if (std::abs(direction.dot(hits[l].geometric.cast<double>())) < depth_camera.least_cosine) continue;
      picture.distances[pixel] = static_cast<double>(hits[l].distance);
    }
  }
  return picture;
}

/// Joins pixels to a surface.
class PictureSurface {
 public:
  PictureSurface(const DepthPicture& picture, const DepthCamera& camera)
      : picture_(picture), position_(camera.camera.position), columns_(camera.columns), rows_(camera.rows) {
    const double slope = std::sqrt(1.0 / (camera.least_cosine * camera.least_cosine) - 1.0);
    most_jump_ = slope * 2.0 * std::tan(0.5 * camera.camera.fov) / rows_;
  }

  TriangleMesh make() {
    vertex_of_.assign(picture_.distances.size(), -1);
    for (std::size_t i = 0; i < picture_.distances.size(); ++i) {
      if (picture_.distances[i] == 0.0) continue;
      vertex_of_[i] = static_cast<int>(mesh_.vertices.size());
      mesh_.vertices.emplace_back(position_ + picture_.distances[i] * picture_.directions[i]);
    }
    for (int row = 0; row + 1 < rows_; ++row)
      for (int column = 0; column + 1 < columns_; ++column) {
        const int upper = row * columns_ + column, lower = upper + columns_;
        join(upper, lower, upper + 1);
        join(upper + 1, lower, lower + 1);
      }
    return std::move(mesh_);
  }

 private:
  /// Of surfaces that are not seen too flat, neighbouring pixels differ by less.
  void join(int a, int b, int c) {
    const auto [least, most] = std::minmax({distance(a), distance(b), distance(c)});
    if (least == 0.0 || most - least > most_jump_ * most) return;
    mesh_.triangles.push_back({vertex(a), vertex(b), vertex(c)});
  }
  double distance(int pixel) const { return picture_.distances[static_cast<std::size_t>(pixel)]; }
  int vertex(int pixel) const { return vertex_of_[static_cast<std::size_t>(pixel)]; }

  const DepthPicture& picture_;
  Vec3 position_;  ///< of the camera
  int columns_, rows_;
  double most_jump_;  ///< between neighbours, over their distance
  std::vector<int> vertex_of_;
  TriangleMesh mesh_;
};

}  // namespace

PointCloud take_depth_view(const TriangleMesh& mesh, const DepthCamera& depth_camera, std::uint64_t seed) {
  const RenderScene scene = scene_of(mesh);
  const DepthPicture picture = take_picture(RayScene(scene), depth_camera);
  PointCloud cloud;
  cloud.viewpoint = depth_camera.camera.position;
  RandomStream random({seed, 0x64657074ULL});
  for (std::size_t i = 0; i < picture.distances.size(); ++i) {
    const double noise = random.normal(), distance = picture.distances[i];
    if (distance == 0.0) continue;
    cloud.points.push_back(depth_camera.camera.position +
                           (distance + noise * depth_camera.noise * distance * distance) *
                               picture.directions[i]);
  }
  return cloud;
}

std::vector<TriangleMesh> take_surface_views(const TriangleMesh& mesh, std::span<const DepthCamera> cameras) {
  const RenderScene scene = scene_of(mesh);
  const RayScene rays_of(scene);
  std::vector<TriangleMesh> views;
  for (const DepthCamera& camera : cameras)
    views.push_back(PictureSurface(take_picture(rays_of, camera), camera).make());
  return views;
}

}  // namespace eigengrasp
