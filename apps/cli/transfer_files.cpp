// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/transfer_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/render/picture_grid.hpp"
#include "eigengrasp/render/pictures.hpp"

namespace eigengrasp::cli {

namespace {

using Json = nlohmann::ordered_json;

Json neighbor_json(const UsedNeighbor& n, int form_closed) {
  const Eigen::Matrix4d X = n.alignment.matrix(1.0);
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({X(i, 0), X(i, 1), X(i, 2), X(i, 3)});
  return {{"object", n.object},
          {"distance", n.distance},
          {"approximate_radius", n.radius},
          {"scales", n.scales},
          {"alignment", {{"method", n.alignment.method}, {"overlap", n.alignment.overlap}, {"X_ON", rows}}},
          {"pregrasps", n.candidates},
          {"form_closed", form_closed}};
}

Scene neighbor_scene(const StoredModel& model, double scale, const std::shared_ptr<const HandModel>& hand) {
  Scene scene;
  scene.hand = hand;
  scene.object = std::make_shared<const ObjectModel>(rescaled(load_stored_object(model), scale));
  return scene;
}

}  // namespace

std::string transfer_json(const TransferResult& result, const std::string& store) {
  Json neighbors = Json::array(), origins = Json::array();
  for (std::size_t i = 0; i < result.neighbors.size(); ++i)
    neighbors.push_back(neighbor_json(result.neighbors[i], result.form_closed[i]));
  for (const CandidateOrigin& o : result.origins)
    origins.push_back({{"neighbor", o.neighbor + 1},
                       {"object", o.grasp.object},
                       {"scale", o.grasp.object_scale},
                       {"hand", o.grasp.hand},
                       {"epsilon", o.grasp.epsilon}});
  const Json json = {{"format", "eigengrasp-transfer"},
                     {"version", 1},
                     {"store", store},
                     {"neighbors", neighbors},
                     {"grasps", origins},
                     {"seconds",
                      {{"prepare", result.timings.prepare},
                       {"neighbors", result.timings.neighbors},
                       {"rate", result.timings.rate},
                       {"total", result.timings.total}}}};
  return json.dump(2) + "\n";
}

Image transfer_picture(const Scene& scene, const TransferStore& store, const TransferResult& result,
                       const std::shared_ptr<const HandModel>& from_hand, std::size_t most, int threads) {
  PictureOptions options;
  options.threads = threads;
  options.tile = 300;
  std::vector<Image> above, below;
  std::vector<std::string> above_text, below_text;
  for (std::size_t i = 0; i < result.origins.size() && above.size() < most; ++i) {
    const CandidateOrigin& origin = result.origins[i];
    const UsedNeighbor& neighbor = result.neighbors[origin.neighbor];
    const Grasp& grasp = result.plan.grasps[i];
    try {
      const Scene other = neighbor_scene(*store.find(neighbor.object), origin.grasp.object_scale, from_hand);
      GraspTile tile = grasp_tile(scene, grasp, options);
      PictureOptions alike = options;
      alike.view = neighbor.alignment.R.transpose() * tile.view;
      alike.up = neighbor.alignment.R.transpose() * Vec3::UnitZ();
      above.push_back(grasp_tile(other, origin.grasp, alike).image);
      below.push_back(std::move(tile.image));
    } catch (const Error&) {
      continue;
    }
    above_text.push_back(
        fmt::format("{}. {} x {:g}", origin.neighbor + 1, neighbor.object, origin.grasp.object_scale));
    below_text.push_back(fmt::format("\u03b5 {:.3f}", grasp.epsilon));
  }
  if (above.empty()) fail("no neighbour's geometry can be read, so that there is nothing to draw");
  PictureGrid grid;
  grid.columns = static_cast<int>(above.size());
  grid.tiles = std::move(above);
  grid.tiles.insert(grid.tiles.end(), below.begin(), below.end());
  grid.captions = std::move(above_text);
  grid.captions.insert(grid.captions.end(), below_text.begin(), below_text.end());
  grid.heading = fmt::format("{}: grasps of neighbours above, on the object below", scene.object->name);
  return draw_grid(grid);
}

}  // namespace eigengrasp::cli
