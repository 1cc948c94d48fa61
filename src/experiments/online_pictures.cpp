// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include "eigengrasp/experiments/online_trial.hpp"
#include "eigengrasp/grasp/named_joints.hpp"
#include "eigengrasp/render/picture_grid.hpp"
#include "experiments/tile_painter.hpp"

namespace eigengrasp {

ResultPicture online_picture(const Scene& scene, const OnlineSceneTrial& trial, int threads) {
  const TilePainter painter(scene, threads);
  std::vector<RenderScene> scenes;
  std::vector<Vec3> framed;
  PictureGrid grid;
  for (const OnlineMoment& m : trial.moments) {
    RenderScene drawn = painter.add(m.joints, m.X_OH);
    const std::vector<Vec3> points = drawn.framed_points();
    framed.insert(framed.end(), points.begin(), points.end());
    if (m.offer) {
      painter.add_ghost(drawn, joints_by_name(painter.hand(), m.offer->pregrasp_joints),
                        m.offer->X_OH_pregrasp);
      grid.captions.push_back(fmt::format("offered: \u03b5 {:.3f}", m.offer->epsilon));
    } else {
      grid.captions.push_back(m.closed ? fmt::format("\u03b5 {:.3f}", m.closed->epsilon) : "");
    }
    if (m.closed) painter.add_contacts(drawn, *m.closed);
    grid.titles.push_back(m.title);
    scenes.push_back(std::move(drawn));
  }
  if (scenes.empty()) return {};
  const Vec3 direction =
      pick_view(scenes.back(), TilePainter::contact_points(*trial.moments.back().closed), Vec3::UnitZ());
  for (const RenderScene& s : scenes) grid.tiles.push_back(painter.draw(s, framed, direction));
  grid.columns = static_cast<int>(scenes.size());
  return {fmt::format("online/approach-{}-{}.png", trial.hand, trial.object),
          fmt::format("One complete approach (Fig. 8): {} and {}, the offered grasp as a ghost", trial.hand,
                      trial.object),
          draw_grid(grid)};
}

}  // namespace eigengrasp
