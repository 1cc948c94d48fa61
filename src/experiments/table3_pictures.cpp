// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/experiments/table3_report.hpp"
#include "eigengrasp/grasp/named_joints.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/render/picture_grid.hpp"
#include "experiments/tile_painter.hpp"

namespace eigengrasp {

namespace {

constexpr std::size_t n_tiles = 6;

struct Shown {
  StoredModel model;
  Grasp grasp;
};

/// Of every object that has form-closed grasps the best and the worst.
struct Extremes {
  std::vector<Shown> best, worst;
};

Extremes read_extremes(GraspStore& store, const std::string& hand) {
  Extremes found;
  for (const StoredModel& model : store.models()) {
    std::vector<StoredGrasp> grasps = store.grasps(model.name, hand);
    std::erase_if(grasps,
                  [](const StoredGrasp& g) { return !g.grasp.form_closure || g.grasp.grasp_joints.empty(); });
    if (grasps.empty()) continue;
    const auto [low, high] = std::minmax_element(
        grasps.begin(), grasps.end(),
        [](const StoredGrasp& a, const StoredGrasp& b) { return a.grasp.epsilon < b.grasp.epsilon; });
    found.best.push_back({model, high->grasp});
    found.worst.push_back({model, low->grasp});
  }
  return found;
}

std::vector<Shown> spread(const std::vector<Shown>& all) {
  std::vector<Shown> some;
  const std::size_t n = std::min(n_tiles, all.size());
  for (std::size_t i = 0; i < n; ++i) some.push_back(all[(2 * i + 1) * all.size() / (2 * n)]);
  return some;
}

std::vector<Shown> lowest(std::vector<Shown> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Shown& a, const Shown& b) { return a.grasp.epsilon < b.grasp.epsilon; });
  if (all.size() > n_tiles) all.resize(n_tiles);
  return all;
}

void add_tile(PictureGrid& grid, const Shown& shown, const std::shared_ptr<const HandModel>& hand,
              int threads) {
  Scene scene;
  scene.hand = hand;
  try {
    const ObjectModel object = load_stored_object(shown.model);
    scene.object = std::make_shared<const ObjectModel>(rescaled(object, shown.grasp.object_scale));
  } catch (const Error&) {
    return;  // gone since
  }
  const TilePainter painter(scene, threads);
  RenderScene drawn = painter.add(joints_by_name(*hand, shown.grasp.grasp_joints), shown.grasp.X_OH);
  const std::vector<Vec3> framed = drawn.framed_points();
  const Vec3 direction = pick_view(drawn, TilePainter::contact_points(shown.grasp), Vec3::UnitZ());
  painter.add_contacts(drawn, shown.grasp);
  grid.tiles.push_back(painter.draw(drawn, framed, direction));
  grid.titles.push_back(shown.model.tags.empty()
                            ? shown.model.name
                            : fmt::format("{}: {}", shown.model.name, shown.model.tags.back()));
  grid.captions.push_back(
      fmt::format("scale {}, \u03b5 {:.4f}", shown.grasp.object_scale, shown.grasp.epsilon));
}

void add_picture(const std::vector<Shown>& shown, const std::shared_ptr<const HandModel>& hand, int threads,
                 const std::string& kind, const std::string& caption, std::vector<ResultPicture>& pictures) {
  PictureGrid grid;
  grid.columns = static_cast<int>(n_tiles);
  for (const Shown& s : shown) add_tile(grid, s, hand, threads);
  if (grid.tiles.empty()) return;
  pictures.push_back({fmt::format("grasp-database/{}-{}.png", kind, hand->name),
                      fmt::format("{}: {}", hand->name, caption), draw_grid(grid)});
}

}  // namespace

std::vector<ResultPicture> table3_pictures(GraspStore& store,
                                           const std::vector<std::shared_ptr<const HandModel>>& hands,
                                           int threads) {
  std::vector<ResultPicture> pictures;
  for (const auto& hand : hands) {
    const Extremes found = read_extremes(store, hand->name);
    add_picture(spread(found.best), hand, threads, "good", "the best grasp of objects all over the store",
                pictures);
    add_picture(lowest(found.worst), hand, threads, "odd", "the grasps of the lowest epsilon", pictures);
  }
  return pictures;
}

}  // namespace eigengrasp
