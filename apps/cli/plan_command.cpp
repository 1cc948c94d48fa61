// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/plan_options_cli.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/render/image.hpp"
#include "eigengrasp/render/pictures.hpp"
#include "eigengrasp/report/grasp_file.hpp"
#include "eigengrasp/report/grasp_glb.hpp"
#include "eigengrasp/report/grasp_tables.hpp"

namespace eigengrasp::cli {

namespace {

struct PlanChoice {
  SceneChoice scene;
  PlannerChoice planner;
  std::filesystem::path out;
  int rows = 20;
  bool pictures = true;
};

/// Ctrl-C ends the search, not the program.
PlanResult plan_with_progress(const Scene& scene, PlanOptions options) {
  ProgressBar bar;
  const InterruptGuard guard;
  options.stop = &guard.stop_flag();
  options.progress = [&](const PlanProgress& p) {
    const double share = p.iterations_total > 0
                             ? static_cast<double>(p.iterations) / static_cast<double>(p.iterations_total)
                             : p.seconds / options.time_limit;
    bar.show(share, fmt::format("{} states, best energy {:.1f}", p.iterations, p.best_energy));
  };
  return plan_grasps(scene, options);
}

void write_files(const Scene& scene, const PlanChoice& choice, const GraspFile& file) {
  const auto& grasps = file.result.grasps;
  save_grasps(file, choice.out / "grasps.json");
  save_grasps_csv(grasps, choice.out / "grasps.csv");
  if (grasps.empty() || !choice.pictures) return;
  PictureOptions picture;
  picture.threads = file.options.threads;
  picture.heading =
      fmt::format("{}  -  {}: {} of {} pre-grasps form-closed",
                  scene.hand->title.empty() ? scene.hand->name : scene.hand->title, scene.object->name,
                  file.result.candidates.form_closed, file.result.candidates.tested);
  save_png(grasps_picture(scene, grasps, picture), choice.out / "grasps.png");
  save_grasp_glb(scene, grasps.front(), choice.out / "grasps.glb");
}

void print_summary(const Scene& scene, const PlanResult& result, const PlanChoice& choice) {
  fmt::print("{} on {} (radius {:.0f} mm)\n", scene.hand->name, scene.object->name,
             1000.0 * scene.object->max_radius);
  if (!result.grasps.empty()) fmt::print("{}", grasps_table(*scene.hand, result.grasps, choice.rows));
  fmt::print("{}{}\n", result.stopped_early ? "stopped early; " : "", result.explanation);
  const PlanTimings& t = result.timings;
  fmt::print(
      "{} states in {:.3f} s, {} pre-grasps closed and rated in {:.3f} s, volumes of the kept ones {:.2f} s, "
      "preparation {:.2f} s\n",
      result.states.evaluated, t.anneal, result.closed_on_the_way, t.close, t.volume, t.prepare);
  fmt::print("written to {}\n", choice.out.string());
}

int run_plan(PlanChoice choice) {
  const Scene scene = load_scene(choice.scene);
  const PlanOptions options = understand(choice.planner, *scene.hand);
  require_sound(options, *scene.hand);
  if (choice.out.empty())
    choice.out = std::filesystem::path("out") / (scene.object->name + "-" + scene.hand->name);
  require_writable_folder(choice.out);
  PlanResult result = plan_with_progress(scene, options);
  const GraspFile file = make_grasp_file(scene, object_units(choice.scene), options, std::move(result));
  write_files(scene, choice, file);
  print_summary(scene, file.result, choice);
  return file.result.status == PlanStatus::found ? success : nothing_found;
}

}  // namespace

void add_plan_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<PlanChoice>();
  CLI::App* command = app.add_subcommand("plan", "Plan form-closure grasps of an object");
  command->add_option("object", choice->scene.object, "Mesh file, GraspIt! body, or a shipped object's name");
  add_scene_options(*command, choice->scene);
  add_planner_options(*command, choice->planner);
  command->add_option("--out", choice->out,
                      "Folder for grasps.json, .csv, .png, .glb (default: out/OBJECT-HAND)");
  command->add_option("--rows", choice->rows, "Lines of the table (0: all)");
  command->add_flag("!--no-pictures", choice->pictures, "No grasps.png and grasps.glb");
  command->footer(
      "Examples:\n"
      "  eigengrasp plan glass --hand human\n"
      "  eigengrasp plan part.stl --units mm --hand barrett-rubber --table auto --time 2s\n"
      "  eigengrasp plan mug.xml --hand models/robots/DLR/DLR.xml --contacts palm.xml,phlx_distal.xml\n"
      "Exit code: 0 grasps found, 1 none found, 2 bad input.");
  command->callback([command, choice, &exit_code] {
    choice->planner.iterations_given = command->count("--iterations") > 0;
    exit_code = run_plan(*choice);
  });
}

}  // namespace eigengrasp::cli
