// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/experiments/table2_report.hpp"
#include "eigengrasp/grasp/named_joints.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/render/picture_grid.hpp"
#include "eigengrasp/render/pictures.hpp"
#include "experiments/table2_text.hpp"
#include "experiments/tile_painter.hpp"

namespace eigengrasp {

namespace {

/// The nearest to what the paper shows.
template <typename T>
T preferred(const std::vector<T>& there, T wanted) {
  return std::find(there.begin(), there.end(), wanted) != there.end() ? wanted : there.front();
}

/// The best state at several iterations: at 0.1, 1, 10, ... percent of the search.
std::vector<SearchMilestone> milestones_at(const std::vector<SearchMilestone>& all, std::int64_t iterations) {
  std::vector<SearchMilestone> picked;
  for (const double share : {0.0, 0.003, 0.03, 0.1, 0.3, 1.0}) {
    const SearchMilestone* last = nullptr;
    for (const SearchMilestone& m : all)
      if (!last || static_cast<double>(m.iteration) <= share * static_cast<double>(iterations)) last = &m;
    if (last && (picked.empty() || last->iteration > picked.back().iteration)) picked.push_back(*last);
  }
  return picked;
}

std::vector<ResultPicture> figure2(const Table2& table, int threads) {
  const PaperHand hand = preferred(table.options.hands, PaperHand::human);
  const PaperObject object = preferred(table.options.objects, PaperObject::glass);
  const Table2Cell& cell = table.part(SearchKind::paper, FrictionCase::materials).cell(hand, object);
  const auto states = milestones_at(cell.runs.front().milestones, table.options.iterations);
  if (states.empty()) return {};
  const TilePainter painter(table.scenes.scene(hand, object, FrictionCase::materials), threads);
  const auto scene_of = [&](const SearchMilestone& m) {
    return painter.add(joint_values(painter.hand(), m.dofs), m.X_OH);
  };
  const Vec3 direction = pick_view(scene_of(states.back()), {}, Vec3::UnitZ());
  PictureGrid grid;
  grid.columns = std::min(static_cast<int>(states.size()), 6);
  for (const SearchMilestone& m : states) {
    const RenderScene scene = scene_of(m);
    grid.tiles.push_back(painter.draw(scene, scene.framed_points(), direction));
    grid.titles.push_back(fmt::format("state {}", m.iteration));
    grid.captions.push_back(fmt::format("energy {:.1f}", m.energy));
  }
  return {{"table2/figure2.png",
           fmt::format("Fig. 2: the best state so far of the paper's search, {} hand, {}, seed 1, materials "
                       "of the models",
                       title_of(hand), name_of(object)),
           draw_grid(grid)}};
}

/// Pre-grasp and grasp from the same place.
std::array<Image, 2> draw_pair(const TilePainter& painter, const Grasp& grasp) {
  RenderScene before =
      painter.add(joints_by_name(painter.hand(), grasp.pregrasp_joints), grasp.X_OH_pregrasp);
  RenderScene after = painter.add(joints_by_name(painter.hand(), grasp.grasp_joints), grasp.X_OH);
  const Vec3 direction = pick_view(after, TilePainter::contact_points(grasp), Vec3::UnitZ());
  std::vector<Vec3> framed = before.framed_points();
  const std::vector<Vec3> more = after.framed_points();
  framed.insert(framed.end(), more.begin(), more.end());
  painter.add_contacts(after, grasp);
  return {painter.draw(before, framed, direction), painter.draw(after, framed, direction)};
}

std::string rating(const Grasp& grasp) {
  return grasp.form_closure ? fmt::format("\u03b5 {:.3f}", grasp.epsilon) : "not closed";
}

ResultPicture figures3and4(const Table2& table, const Table2Part& part, PaperHand hand, int threads) {
  PictureGrid grid;
  const auto& objects = table.options.objects;
  const std::size_t n = objects.size();
  grid.columns = static_cast<int>(n);
  grid.tiles.resize(2 * n);
  grid.titles.resize(2 * n);
  grid.captions.resize(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    grid.titles[i] = name_of(objects[i]);
    const auto& grasp = part.cell(hand, objects[i]).runs.front().best;
    if (!grasp) continue;
    const TilePainter painter(table.scenes.scene(hand, objects[i], part.friction), threads);
    auto [before, after] = draw_pair(painter, *grasp);
    grid.tiles[i] = std::move(before);
    grid.tiles[n + i] = std::move(after);
    grid.captions[i] = fmt::format("energy {:.1f}", grasp->energy);
    grid.captions[n + i] = rating(*grasp);
  }
  return {fmt::format("table2/grasps-{}.png", name_of(hand)),
          fmt::format(
              "Figs. 3 and 4, {} hand: pre-grasp and grasp of the largest epsilon on each object; {}, seed 1",
              title_of(hand), title_of(part)),
          draw_grid(grid)};
}

}  // namespace

std::vector<ResultPicture> table2_pictures(const Table2& table, int threads) {
  std::vector<ResultPicture> pictures = figure2(table, threads);
  const Table2Part& part = table.part(SearchKind::staged, FrictionCase::one);
  for (const PaperHand hand : table.options.hands)
    pictures.push_back(figures3and4(table, part, hand, threads));
  return pictures;
}

}  // namespace eigengrasp
