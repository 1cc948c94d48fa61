// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>

#include "surface.hpp"

namespace eigengrasp {

namespace {

const SurfacePtr& ball_surface() {
  static const SurfacePtr surface = make_surface(unit_ball());
  return surface;
}

const SurfacePtr& cone_surface() {
  // The cone's own side is steep at its apex for large friction: only its rim stays sharp.
  static const SurfacePtr surface = make_surface(unit_cone());
  return surface;
}

const SurfacePtr& cylinder_surface() {
  static const SurfacePtr surface = make_surface(unit_cylinder());
  return surface;
}

/// A pose at a point with its z axis along a direction.
Pose along(const Vec3& p_W, const Vec3& axis_W) {
  return make_pose(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis_W), p_W);
}

}  // namespace

RenderItem& RenderScene::add(SurfacePtr surface, const Pose& X_WM, const Color& color) {
  RenderItem item;
  item.surface = std::move(surface);
  item.X_WM = X_WM;
  item.color = color;
  items_.push_back(item);
  return items_.back();
}

RenderItem& RenderScene::add(const TriangleMesh& mesh, const Pose& X_WM, const Color& color) {
  return add(make_surface(mesh), X_WM, color);
}

RenderItem& RenderScene::add_sphere(const Vec3& center_W, double radius, const Color& color) {
  RenderItem& item = add(ball_surface(), make_pose(Eigen::Quaterniond::Identity(), center_W), color);
  item.scale = Vec3::Constant(radius);
  item.see_through = 0.45;
  item.framed = false;
  item.interest = 0.0;
  return item;
}

RenderItem& RenderScene::add_cone(const Vec3& apex_W, const Vec3& axis_W, double mu, double length,
                                  const Color& color) {
  RenderItem& item = add(cone_surface(), along(apex_W, axis_W), color);
  const double radius = std::max(mu, 0.02) * length;
  item.scale = Vec3(radius, radius, length);
  item.see_through = 0.5;
  item.group = new_group();
  item.framed = false;
  item.interest = 0.0;
  return item;
}

void RenderScene::add_arrow(const Vec3& from_W, const Vec3& direction_W, double length, const Color& color) {
  const double head = 0.36 * length;
  RenderItem& shaft = add(cylinder_surface(), along(from_W, direction_W), color);
  shaft.scale = Vec3(0.045 * length, 0.045 * length, length - head);
  RenderItem& tip = add(cone_surface(), along(from_W + length * direction_W, -direction_W), color);
  tip.scale = Vec3(0.13 * length, 0.13 * length, head);
  for (std::size_t i = items_.size() - 2; i < items_.size(); ++i) {
    items_[i].see_through = 0.25;
    items_[i].framed = false;
    items_[i].interest = 0.0;
  }
}

void RenderScene::add_floor(double z, double radius) {
  TriangleMesh square;
  square.vertices = {{-radius, -radius, z}, {radius, -radius, z}, {radius, radius, z}, {-radius, radius, z}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  RenderItem& item = add(square, Pose::Identity(), Color{1.0F, 1.0F, 1.0F, 1.0F});
  item.shadow_only = true;
  item.framed = false;
  item.interest = 0.0;
}

std::vector<Vec3> RenderScene::framed_points() const {
  std::vector<Vec3> points;
  for (const RenderItem& item : items_) {
    if (!item.framed) continue;
    for (const Vec3& p : item.surface->vertices()) points.push_back(item.X_WM * item.scale.cwiseProduct(p));
  }
  return points;
}

Box RenderScene::framed_box() const {
  Box box;
  for (const Vec3& p : framed_points()) box.add(p);
  return box;
}

}  // namespace eigengrasp
