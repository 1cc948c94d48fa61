// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "tiles.hpp"

namespace eigengrasp {

namespace {

struct View {
  Vec3 direction;
  Vec3 up;
};

View view_of(const HandModel& hand, const PictureOptions& options) {
  return {options.view.value_or(hand_view(hand)), options.up.value_or(finger_direction(hand))};
}

std::string title_of(const HandModel& hand) {
  return hand.title.empty() ? hand.name : hand.title;
}

/// The title up to its first comma.
std::string short_title_of(const HandModel& hand) {
  const std::string title = title_of(hand);
  return title.substr(0, title.find(','));
}

VecX rest_joints(const HandModel& hand) {
  return joint_values(hand, hand.rest_posture());
}

Camera frame(const RenderScene& scene, const View& view) {
  return frame_camera(scene.framed_points(), view.direction, view.up, kDefaultFov, 1.0, kTileMargin);
}

void require_geometry(const HandModel& hand) {
  for (const HandLink& link : hand.links)
    if (!link.mesh.empty()) return;
  fail("the hand \"{}\" has no link with a mesh, expected at least one to draw", hand.name);
}

/// Adds the virtual contacts with their normals; returns where the arrows end.
std::vector<Vec3> add_virtual_contacts(RenderScene& scene, const HandModel& hand, const Palette& palette) {
  std::vector<Pose> X_HL;
  compute_link_poses(hand, rest_joints(hand), Pose::Identity(), X_HL);
  const double size = scene.framed_box().diagonal();
  std::vector<Vec3> ends;
  for (const VirtualContact& contact : hand.virtual_contacts) {
    const Pose& X = X_HL[static_cast<std::size_t>(contact.link)];
    const Vec3 p = X * contact.p_LC;
    const Vec3 n = X.linear() * contact.n_LC;
    scene.add_sphere(p, 0.010 * size, palette.contact);
    scene.add_arrow(p, n, 0.085 * size, palette.arrow);
    ends.emplace_back(p + 0.085 * size * n);
  }
  return ends;
}

/// The hand at one amplitude of one eigengrasp, the others 0; joints stop at their limits.
TileScene amplitude_scene(const DrawnHand& drawn, int eigengrasp, double amplitude,
                          const PictureOptions& options) {
  const HandModel& hand = drawn.hand();
  VecX amplitudes = VecX::Zero(hand.eigengrasps.size());
  if (eigengrasp >= 0) amplitudes[eigengrasp] = amplitude;
  const VecX posture = clamp_posture(hand, hand.eigengrasps.embed(amplitudes));
  TileScene tile;
  drawn.add_to(tile.scene, joint_values(hand, posture), Pose::Identity(), options.palette);
  return tile;
}

/// One camera for all scenes, so that postures can be compared.
void frame_together(std::vector<TileScene>& tiles, const View& view) {
  std::vector<Vec3> points;
  for (const TileScene& tile : tiles) {
    const std::vector<Vec3> more = tile.scene.framed_points();
    points.insert(points.end(), more.begin(), more.end());
  }
  const Camera camera = frame_camera(points, view.direction, view.up, kDefaultFov, 1.0, kTileMargin);
  for (TileScene& tile : tiles) tile.camera = camera;
}

}  // namespace

Image hand_picture(const std::shared_ptr<const HandModel>& hand, const VecX& joints,
                   const PictureOptions& options) {
  require_geometry(*hand);
  TileScene tile;
  DrawnHand(hand).add_to(tile.scene, joints, Pose::Identity(), options.palette);
  tile.camera = frame(tile.scene, view_of(*hand, options));
  PictureGrid grid;
  grid.tiles = draw_tiles({tile}, options);
  grid.heading = heading_or(options, title_of(*hand));
  return draw_grid(grid);
}

Image hand_contacts_picture(const std::shared_ptr<const HandModel>& hand, const PictureOptions& options) {
  require_geometry(*hand);
  const View oblique = view_of(*hand, options);
  const Vec3 across = -oblique.direction + oblique.direction.dot(oblique.up) * oblique.up;
  const Vec3 front = hand->approach_direction_H - hand->approach_direction_H.dot(oblique.up) * oblique.up;
  View facing = oblique;  // seen from the palm, or from the side where the palm looks along the fingers
  facing.direction = front.norm() > 0.35 ? Vec3(-front) : Vec3(-oblique.up.cross(across));
  const DrawnHand drawn(hand);
  std::vector<TileScene> tiles;
  for (const View& view : {facing, oblique}) {
    TileScene tile;
    drawn.add_to(tile.scene, rest_joints(*hand), Pose::Identity(), options.palette);
    std::vector<Vec3> points = tile.scene.framed_points();
    const std::vector<Vec3> ends = add_virtual_contacts(tile.scene, *hand, options.palette);
    points.insert(points.end(), ends.begin(), ends.end());
    tile.camera = frame_camera(points, view.direction, view.up, kDefaultFov, 1.0, kTileMargin);
    tiles.push_back(std::move(tile));
  }
  PictureGrid grid;
  grid.columns = 2;
  grid.tiles = draw_tiles(tiles, options);
  grid.heading = heading_or(
      options, fmt::format("{}: {} virtual contacts", short_title_of(*hand), hand->virtual_contacts.size()));
  return draw_grid(grid);
}

Image eigengrasp_picture(const std::shared_ptr<const HandModel>& hand, int rows,
                         const PictureOptions& options) {
  require_geometry(*hand);
  const EigengraspSpace& space = hand->eigengrasps;
  const int n = std::min(rows, space.size());
  if (n < 1) fail("the hand \"{}\" has no eigengrasps to draw, expected at least one", hand->name);
  const DrawnHand drawn(hand);
  std::vector<TileScene> tiles;
  PictureGrid grid;
  for (int i = 0; i < n; ++i) {
    const Eigengrasp& e = space[i];
    for (const double amplitude : {e.min, 0.0, e.max})
      tiles.push_back(amplitude_scene(drawn, i, amplitude, options));
    for (const char* end : {"smallest", "", "largest"})
      grid.titles.push_back(*end == 0 ? "origin" : fmt::format("eigengrasp {}, {}", i + 1, end));
    grid.captions.push_back(fmt::format("a{} = {:.2f}", i + 1, e.min));
    grid.captions.push_back(e.name);
    grid.captions.push_back(fmt::format("a{} = {:.2f}", i + 1, e.max));
  }
  frame_together(tiles, view_of(*hand, options));
  grid.columns = 3;
  grid.tiles = draw_tiles(tiles, options);
  grid.heading = heading_or(options, short_title_of(*hand) + ": eigengrasps");
  return draw_grid(grid);
}

Image hands_side_by_side(std::span<const std::shared_ptr<const HandModel>> hands,
                         std::vector<std::string> captions, const PictureOptions& options) {
  if (hands.empty()) fail("no hand to draw, expected at least one");
  std::vector<TileScene> tiles;
  PictureGrid grid;
  const View first = view_of(*hands.front(), options);
  bool alike = true;  // the same hand in other clothes keeps the same view
  for (const auto& hand : hands) {
    require_geometry(*hand);
    alike = alike && hand->n_dof() == hands.front()->n_dof();
    TileScene tile;
    DrawnHand(hand).add_to(tile.scene, rest_joints(*hand), Pose::Identity(), options.palette);
    tile.camera = frame(tile.scene, view_of(*hand, options));
    tiles.push_back(std::move(tile));
    grid.titles.push_back(short_title_of(*hand));
  }
  if (alike) frame_together(tiles, first);
  grid.columns = hands.size() <= 4 && options.columns == 0 ? static_cast<int>(hands.size())
                                                           : sheet_columns(hands.size(), options);
  grid.captions = std::move(captions);
  grid.heading = options.heading;
  grid.tiles = draw_tiles(tiles, options);
  return draw_grid(grid);
}

}  // namespace eigengrasp
