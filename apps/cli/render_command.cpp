// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/render/image.hpp"
#include "eigengrasp/render/pictures.hpp"
#include "eigengrasp/report/grasp_file.hpp"
#include "eigengrasp/report/grasp_glb.hpp"
#include "eigengrasp/report/grasp_tables.hpp"

namespace eigengrasp::cli {

namespace {

struct RenderChoice {
  std::filesystem::path grasps;
  SceneChoice scene;
  std::filesystem::path png;
  std::filesystem::path glb;
  std::filesystem::path isaac;
  int top = 20;
  int rank = 0;
  int tile = 400;
  bool cones = false;
};

/// Hand, object and obstacles as the file names them, where the user does not say otherwise.
Scene scene_of(const GraspFile& file, SceneChoice choice) {
  if (choice.hand.name.empty()) choice.hand.name = file.hand.source.path;
  if (choice.object.empty() && choice.world.empty()) {
    choice.object = file.object.source.path;
    if (choice.units.empty()) choice.units = file.object.units;
    choice.scale *= file.object.scale;
  }
  Scene scene = load_scene(choice);
  if (!scene.obstacles.empty()) return scene;
  for (const ObstacleRecord& o : file.obstacles) {
    if (o.source.path.empty()) continue;
    SceneChoice one = choice;
    one.object = o.source.path;
    scene.obstacles.push_back({load_scene(one).object, o.X_OB});
  }
  return scene;
}

void run_render(const RenderChoice& choice) {
  const GraspFile file = load_grasps(choice.grasps);
  const auto& all = file.result.grasps;
  if (all.empty()) fail("{}: holds no grasps, nothing to draw", choice.grasps.string());
  if (choice.rank < 0 || choice.rank > static_cast<int>(all.size()))
    fail("--rank is {}, expected 1 to {}, the grasps of {}", choice.rank, all.size(), choice.grasps.string());
  if (choice.tile < 16 || choice.tile > 4096) fail("--tile is {}, expected 16 to 4096 pixels", choice.tile);
  const Scene scene = scene_of(file, choice.scene);
  PictureOptions picture;
  picture.tile = choice.tile;
  picture.friction_cones = choice.cones;
  const Grasp& one = all[static_cast<std::size_t>(std::max(0, choice.rank - 1))];
  const auto png = choice.png.empty() ? choice.grasps.parent_path() / "grasps.png" : choice.png;
  const std::span<const Grasp> shown(all.data(),
                                     std::min(all.size(), static_cast<std::size_t>(std::max(1, choice.top))));
  save_png(choice.rank > 0 ? grasp_pair_picture(scene, one, picture) : grasps_picture(scene, shown, picture),
           png);
  fmt::print("wrote {}\n", png.string());
  if (!choice.glb.empty()) {
    save_grasp_glb(scene, one, choice.glb);
    fmt::print("wrote {}\n", choice.glb.string());
  }
  if (!choice.isaac.empty()) {
    write_file_atomically(choice.isaac, isaac_grasp_yaml(*scene.hand, all));
    fmt::print("wrote {}\n", choice.isaac.string());
  }
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto choice = std::make_shared<RenderChoice>();
  CLI::App* command = app.add_subcommand("render", "Draw the grasps of a grasps.json again, or export them");
  command->add_option("grasps", choice->grasps, "A grasps.json")->required();
  command->add_option("--object", choice->scene.object, "Instead of the file's object");
  add_scene_options(*command, choice->scene);
  command->add_option("--png", choice->png, "Picture (default: grasps.png beside the file)");
  command->add_option("--top", choice->top, "Draw the best so many");
  command->add_option("--rank", choice->rank,
                      "Draw pre-grasp and grasp of this one alone; export it with --glb");
  command->add_option("--tile", choice->tile, "Side of a tile [pixel]");
  command->add_flag("--cones", choice->cones, "Draw friction cones");
  command->add_option("--glb", choice->glb, "Write the best grasp, or that of --rank, as binary glTF");
  command->add_option("--isaac", choice->isaac, "Write all grasps as isaac_grasp YAML 1.0");
  command->footer(
      "Example:\n  eigengrasp render out/glass-human/grasps.json --rank 1 --cones --png best.png");
  command->callback([choice] { run_render(*choice); });
}

}  // namespace eigengrasp::cli
