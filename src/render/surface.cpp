// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eigengrasp {

namespace {

/// Unit normals and, for each corner, its angle [rad].
struct Facets {
  std::vector<Vec3> normals;  ///< zero for degenerate triangles
  std::vector<std::array<double, 3>> angles;
};

Facets compute_facets(const TriangleMesh& mesh) {
  Facets facets;
  facets.normals.resize(mesh.triangles.size());
  facets.angles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 n = area_normal(mesh, t);
    const double length = n.norm();
    facets.normals[t] = length > 0.0 ? Vec3(n / length) : Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
      const Vec3 b = mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k);
      facets.angles[t][static_cast<std::size_t>(k)] = std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  return facets;
}

struct Corner {
  std::size_t triangle;
  std::size_t k;
};

ScenePtr build_rays(const TriangleMesh& mesh) {
  RTCDevice device = ray_device();
  ScenePtr scene(rtcNewScene(device));
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             std::max<std::size_t>(1, mesh.vertices.size())));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  check_ray_device();
  for (const Vec3& p : mesh.vertices)
    for (int i = 0; i < 3; ++i) *points++ = static_cast<float>(p[i]);
  for (const auto& t : mesh.triangles)
    for (const auto v : t) *indices++ = static_cast<unsigned>(v);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  check_ray_device();
  return scene;
}

TriangleMesh welded(TriangleMesh mesh) {
  weld(mesh, 0.0);
  return mesh;
}

}  // namespace

RTCDevice ray_device() {
  // One thread builds the hierarchies: then they, and with them every picture, are the same in each run.
  static RTCDevice device = rtcNewDevice("threads=1");
  if (device == nullptr) throw std::runtime_error("the ray tracing library cannot be started");
  return device;
}

void check_ray_device() {
  const RTCError error = rtcGetDeviceError(ray_device());
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(
        fmt::format("the ray tracing library reports error {}", static_cast<int>(error)));
}

std::vector<std::array<Vec3f, 3>> corner_normals(const TriangleMesh& mesh, double crease_angle) {
  const Facets facets = compute_facets(mesh);
  std::vector<std::vector<Corner>> corners(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(mesh.triangles[t][k])].push_back({t, k});

  constexpr std::size_t kMostNeighbours = 512;
  const double least_cos = std::cos(crease_angle);
  std::vector<std::array<Vec3f, 3>> normals(mesh.triangles.size());
  for (const auto& around : corners) {
    const std::size_t n_around = std::min(around.size(), kMostNeighbours);
    for (const Corner& corner : around) {
      const Vec3& own = facets.normals[corner.triangle];
      Vec3 sum = 1e-9 * own;
      for (std::size_t i = 0; i < n_around; ++i) {
        const Vec3& other = facets.normals[around[i].triangle];
        const double c = own.dot(other);
        // Neighbours that are turned inside out count with their normal reversed.
        if (std::abs(c) >= least_cos)
          sum += std::copysign(facets.angles[around[i].triangle][around[i].k], c) * other;
      }
      normals[corner.triangle][corner.k] = sum.stableNormalized().cast<float>();
    }
  }
  return normals;
}

Surface::Surface(const TriangleMesh& mesh, double crease_angle) {
  const TriangleMesh whole = welded(mesh);
  vertices_ = whole.vertices;
  normals_ = corner_normals(whole, crease_angle);
  rays_ = build_rays(whole);
}

SurfacePtr make_surface(const TriangleMesh& mesh, double crease_angle) {
  return std::make_shared<const Surface>(mesh, crease_angle);
}

}  // namespace eigengrasp
