// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "experiments/tile_painter.hpp"

#include "eigengrasp/render/camera.hpp"

namespace eigengrasp {

namespace {

constexpr int tile_size = 230;       // [pixel]
constexpr double margin = 0.06;      // of a tile
constexpr double ball_size = 0.011;  // radius of a contact by the size of the picture
constexpr float ghost_alpha = 0.35F;

}  // namespace

TilePainter::TilePainter(Scene scene, int threads) : scene_(std::move(scene)), hand_(scene_.hand) {
  object_ = make_surface(scene_.object->mesh);
  options_.width = options_.height = tile_size;
  options_.threads = threads;
}

RenderScene TilePainter::add(const VecX& joints, const Pose& X_OH) const {
  RenderScene scene;
  hand_.add_to(scene, joints, X_OH, palette_);
  scene.add(object_, Pose::Identity(), palette_.object).interest = 2.0;
  return scene;
}

void TilePainter::add_ghost(RenderScene& scene, const VecX& joints, const Pose& X_OH) const {
  hand_.add_to(scene, joints, X_OH, palette_, ghost_alpha);
}

void TilePainter::add_contacts(RenderScene& scene, const Grasp& grasp) const {
  const double radius = ball_size * scene.framed_box().diagonal();
  for (const Vec3& p_OC : contact_points(grasp)) scene.add_sphere(p_OC, radius, palette_.contact);
}

std::vector<Vec3> TilePainter::contact_points(const Grasp& grasp) {
  std::vector<Vec3> points;
  for (const GraspContact& contact : grasp.contacts) points.push_back(contact.point.p_OC);
  return points;
}

Image TilePainter::draw(const RenderScene& scene, const std::vector<Vec3>& framed,
                        const Vec3& direction) const {
  return render(scene, frame_camera(framed, direction, Vec3::UnitZ(), kDefaultFov, 1.0, margin), options_);
}

}  // namespace eigengrasp
