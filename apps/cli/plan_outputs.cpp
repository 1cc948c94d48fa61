// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/plan_outputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <span>

#include "eigengrasp/core/files.hpp"
#include "eigengrasp/render/image.hpp"
#include "eigengrasp/render/pictures.hpp"
#include "eigengrasp/report/grasp_glb.hpp"
#include "eigengrasp/report/grasp_tables.hpp"

namespace eigengrasp::cli {

namespace {

constexpr std::size_t most_drawn = 40;  // a tile takes half a second, a reader looks at no more

}  // namespace

void PlanOutputs::require_folder(const std::string& name) {
  if (folder.empty()) folder = std::filesystem::path("out") / name;
  require_writable_folder(folder);
}

void add_output_options(CLI::App& command, PlanOutputs& outputs, const std::string& folder) {
  command.add_option("--out", outputs.folder,
                     fmt::format("Folder for grasps.json, .csv, .png, .glb (default: {})", folder));
  command.add_option("--rows", outputs.rows, "Lines of the table (0: all)");
  command.add_flag("!--no-pictures", outputs.pictures, "No grasps.png (the best 40) and grasps.glb");
}

void print_grasps(const Scene& scene, const PlanResult& result, const PlanOutputs& outputs) {
  fmt::print("{} on {} (radius {:.0f} mm)\n", scene.hand->name, scene.object->name,
             1000.0 * scene.object->max_radius);
  if (!result.grasps.empty()) fmt::print("{}", grasps_table(*scene.hand, result.grasps, outputs.rows));
  fmt::print("{}{}\n", result.stopped_early ? "stopped early; " : "", result.explanation);
}

void write_plan_files(const Scene& scene, const GraspFile& file, const PlanOutputs& outputs) {
  const std::vector<Grasp>& grasps = file.result.grasps;
  save_grasps(file, outputs.folder / "grasps.json");
  save_grasps_csv(grasps, outputs.folder / "grasps.csv");
  if (grasps.empty() || !outputs.pictures) return;
  PictureOptions picture;
  picture.threads = file.options.threads;
  const std::span<const Grasp> drawn(grasps.data(), std::min(grasps.size(), most_drawn));
  picture.heading =
      fmt::format("{}  -  {}: {} of {} pre-grasps form-closed{}",
                  scene.hand->title.empty() ? scene.hand->name : scene.hand->title, scene.object->name,
                  file.result.candidates.form_closed, file.result.candidates.tested,
                  drawn.size() < grasps.size() ? fmt::format(", the best {}", drawn.size()) : "");
  save_png(grasps_picture(scene, drawn, picture), outputs.folder / "grasps.png");
  save_grasp_glb(scene, grasps.front(), outputs.folder / "grasps.glb");
}

}  // namespace eigengrasp::cli
