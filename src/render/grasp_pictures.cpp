// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/grasp/named_joints.hpp"
#include "tiles.hpp"

namespace eigengrasp {

namespace {

constexpr double kBallSize = 0.009;    // radius of a contact by the size of the picture
constexpr double kConeLength = 0.045;  // likewise

/// What all tiles of a grasp picture share.
class GraspDrawer {
 public:
  GraspDrawer(const Scene& scene, const PictureOptions& options)
      : options_(options), hand_(scene.hand), object_(make_surface(scene.object->mesh)) {
    for (const Obstacle& obstacle : scene.obstacles)
      obstacles_.push_back({make_surface(obstacle.model->mesh), obstacle.X_OB});
    object_box_ = bounding_box(scene.object->mesh);
  }

  /// Hand, object and obstacles; the camera is left to frame().
  TileScene add(const NamedValues& joints, const Pose& X_OH) const {
    TileScene tile;
    hand_.add_to(tile.scene, joints_by_name(hand_.hand(), joints), X_OH, options_.palette);
    // The object counts as much as two links when the view is picked.
    tile.scene.add(object_, Pose::Identity(), options_.palette.object).interest = 2.0;
    const Box box = tile.scene.framed_box();
    for (const auto& [surface, X_OB] : obstacles_) {
      RenderItem& item = tile.scene.add(surface, X_OB, options_.palette.obstacle);
      item.framed = false;
      item.interest = 0.0;
      item.fade_center_W = object_box_.center();
      item.fade_radius = 0.75 * box.diagonal();
    }
    return tile;
  }

  void add_contacts(RenderScene& scene, const Grasp& grasp) const {
    const double size = scene.framed_box().diagonal();
    for (const GraspContact& contact : grasp.contacts) {
      const ContactPoint& point = contact.point;
      scene.add_sphere(point.p_OC, kBallSize * size, options_.palette.contact);
      if (options_.friction_cones)
        scene.add_cone(point.p_OC, point.n_OC, point.mu, kConeLength * size, options_.palette.cone);
    }
  }

  void frame(TileScene& tile, const Grasp& grasp) const {
    const Vec3 up = options_.up.value_or(Vec3::UnitZ());
    std::vector<Vec3> points;
    for (const GraspContact& contact : grasp.contacts) points.push_back(contact.point.p_OC);
    const Vec3 direction = options_.view ? *options_.view : pick_view(tile.scene, points, up);
    tile.camera = frame_camera(tile.scene.framed_points(), direction, up, kDefaultFov, 1.0, kTileMargin);
  }

 private:
  PictureOptions options_;
  DrawnHand hand_;
  SurfacePtr object_;
  std::vector<std::pair<SurfacePtr, Pose>> obstacles_;
  Box object_box_;
};

std::string rating(const Grasp& grasp) {
  return fmt::format("\u03b5 {:.3f}   energy {:.2f}", grasp.epsilon, grasp.energy);
}

std::string names(const Scene& scene) {
  const std::string hand = scene.hand->title.empty() ? scene.hand->name : scene.hand->title;
  return fmt::format("{} \u2013 {}", hand.substr(0, hand.find(',')), scene.object->name);
}

void require_parts(const Scene& scene) {
  if (!scene.hand || !scene.object) throw std::logic_error("a picture of a scene without hand or object");
}

}  // namespace

Image grasps_picture(const Scene& scene, std::span<const Grasp> grasps, const PictureOptions& options) {
  require_parts(scene);
  if (grasps.empty()) fail("no grasp to draw, expected at least one");
  const GraspDrawer drawer(scene, options);
  std::vector<TileScene> tiles(grasps.size());
  parallel_for(grasps.size(), options.threads, [&](std::size_t i, int) {
    tiles[i] = drawer.add(grasps[i].grasp_joints, grasps[i].X_OH);
    drawer.frame(tiles[i], grasps[i]);
    drawer.add_contacts(tiles[i].scene, grasps[i]);
  });
  PictureGrid grid;
  grid.columns = sheet_columns(grasps.size(), options);
  for (std::size_t i = 0; i < grasps.size(); ++i)
    grid.captions.push_back(
        fmt::format("{}   {}{}", i + 1, rating(grasps[i]), grasps[i].form_closure ? "" : "   not closed"));
  grid.heading = heading_or(options, names(scene));
  grid.tiles = draw_tiles(tiles, options);
  return draw_grid(grid);
}

GraspTile grasp_tile(const Scene& scene, const Grasp& grasp, const PictureOptions& options) {
  require_parts(scene);
  const GraspDrawer drawer(scene, options);
  std::vector<TileScene> tiles;
  tiles.push_back(drawer.add(grasp.grasp_joints, grasp.X_OH));
  drawer.frame(tiles.front(), grasp);
  drawer.add_contacts(tiles.front().scene, grasp);
  return {draw_tiles(tiles, options).front(), tiles.front().camera.forward};
}

Image grasp_pair_picture(const Scene& scene, const Grasp& grasp, const PictureOptions& options) {
  require_parts(scene);
  const GraspDrawer drawer(scene, options);
  std::vector<TileScene> tiles;
  tiles.push_back(drawer.add(grasp.pregrasp_joints, grasp.X_OH_pregrasp));
  tiles.push_back(drawer.add(grasp.grasp_joints, grasp.X_OH));
  drawer.frame(tiles[1], grasp);
  std::vector<Vec3> points = tiles[0].scene.framed_points();
  const std::vector<Vec3> more = tiles[1].scene.framed_points();
  points.insert(points.end(), more.begin(), more.end());
  const Camera& picked = tiles[1].camera;
  const Camera camera = frame_camera(points, picked.forward, picked.up, kDefaultFov, 1.0, kTileMargin);
  for (TileScene& tile : tiles) tile.camera = camera;
  drawer.add_contacts(tiles[1].scene, grasp);
  PictureGrid grid;
  grid.columns = 2;
  grid.titles = {"pre-grasp", "grasp"};
  grid.captions = {fmt::format("energy {:.2f}", grasp.energy),
                   fmt::format("\u03b5 {:.3f}   volume {:.3g}   {} contacts", grasp.epsilon, grasp.volume,
                               grasp.contacts.size())};
  grid.heading = heading_or(options, names(scene));
  grid.tiles = draw_tiles(tiles, options);
  return draw_grid(grid);
}

}  // namespace eigengrasp
