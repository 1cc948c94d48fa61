// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "ray_scene.hpp"

#include <limits>

namespace eigengrasp {

namespace {

bool is_layer(const RenderItem& item) {
  return item.color.a < 1.0F || item.see_through > 0.0;
}

/// A packet's common part of rtcIntersect16 and rtcOccluded16.
void fill_packet(const Rays& rays, RTCRay16& packet, int* valid) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    valid[i] = rays.active[i] ? -1 : 0;
    packet.org_x[i] = rays.origins[i].x();
    packet.org_y[i] = rays.origins[i].y();
    packet.org_z[i] = rays.origins[i].z();
    packet.dir_x[i] = rays.directions[i].x();
    packet.dir_y[i] = rays.directions[i].y();
    packet.dir_z[i] = rays.directions[i].z();
    packet.tnear[i] = rays.near[i];
    packet.tfar[i] = rays.far[i];
    packet.time[i] = 0.0F;
    packet.mask[i] = ~0U;
    packet.id[i] = 0;
    packet.flags[i] = 0;
  }
}

Vec3f towards_viewer(const Vec3f& normal, const Vec3f& direction) {
  return normal.dot(direction) > 0.0F ? Vec3f(-normal) : normal;
}

}  // namespace

RayScene::RayScene(const RenderScene& scene) : items_(scene.items()) {
  RTCDevice device = ray_device();
  solids_.scene.reset(rtcNewScene(device));
  layers_.scene.reset(rtcNewScene(device));
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const RenderItem& item = items_[i];
    const Mat3 turn = item.X_WM.linear() * item.scale.cwiseInverse().asDiagonal();
    placements_.push_back({turn.cast<float>()});
    add(is_layer(item) ? layers_ : solids_, static_cast<int>(i));
  }
  rtcCommitScene(solids_.scene.get());
  rtcCommitScene(layers_.scene.get());
  check_ray_device();
}

void RayScene::add(Part& part, int index) const {
  const RenderItem& item = this->item(index);
  RTCGeometry instance = rtcNewGeometry(ray_device(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, item.surface->rays());
  Eigen::Matrix<float, 3, 4> X;
  X.leftCols<3>() = (item.X_WM.linear() * item.scale.asDiagonal()).cast<float>();
  X.col(3) = item.X_WM.translation().cast<float>();
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, X.data());
  rtcCommitGeometry(instance);
  rtcAttachGeometryByID(part.scene.get(), instance, static_cast<unsigned>(part.indices.size()));
  rtcReleaseGeometry(instance);
  part.indices.push_back(index);
}

SurfaceHit RayScene::make_hit(int item, const RTCRayHit16& packet, int lane, const Vec3f& direction) const {
  const auto i = static_cast<std::size_t>(lane);
  const Eigen::Matrix3f& turn = placements_[static_cast<std::size_t>(item)].normal_turn;
  SurfaceHit hit;
  hit.item = item;
  hit.distance = packet.ray.tfar[i];
  const Vec3f Ng(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
  hit.geometric = towards_viewer((turn * Ng).stableNormalized(), direction);
  const Surface& surface = *this->item(item).surface;
  const Vec3f smooth = turn * surface.normal(packet.hit.primID[i], packet.hit.u[i], packet.hit.v[i]);
  const float length = smooth.norm();
  hit.normal = length > 1e-12F ? Vec3f(smooth / length) : hit.geometric;
  if (hit.normal.dot(hit.geometric) < 0.0F) hit.normal = -hit.normal;
  return hit;
}

void RayScene::trace(const Part& part, const Rays& rays, std::array<SurfaceHit, kLanes>& hits) const {
  RTCRayHit16 packet;
  alignas(64) int valid[kLanes];
  fill_packet(rays, packet.ray, valid);
  for (int i = 0; i < kLanes; ++i) {
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, part.scene.get(), &context, &packet);
  for (std::size_t i = 0; i < kLanes; ++i) {
    hits[i].item = -1;
    if (valid[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const int index = part.indices[packet.hit.instID[0][i]];
    hits[i] = make_hit(index, packet, static_cast<int>(i), rays.directions[i]);
  }
}

std::array<bool, kLanes> RayScene::occluded(const Rays& rays) const {
  RTCRay16 packet;
  alignas(64) int valid[kLanes];
  fill_packet(rays, packet, valid);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, solids_.scene.get(), &context, &packet);
  std::array<bool, kLanes> hidden{};
  for (std::size_t i = 0; i < kLanes; ++i) hidden[i] = valid[i] != 0 && packet.tfar[i] < 0.0F;
  return hidden;
}

}  // namespace eigengrasp
