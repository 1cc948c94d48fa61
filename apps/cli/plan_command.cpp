// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/plan_options_cli.hpp"
#include "cli/plan_outputs.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"

namespace eigengrasp::cli {

namespace {

struct PlanChoice {
  SceneChoice scene;
  PlannerChoice planner;
  PlanOutputs outputs;
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

void print_summary(const Scene& scene, const PlanResult& result, const PlanChoice& choice) {
  print_grasps(scene, result, choice.outputs);
  const PlanTimings& t = result.timings;
  fmt::print(
      "{} states in {:.3f} s, {} pre-grasps closed and rated in {:.3f} s, volumes of the kept ones {:.2f} s, "
      "preparation {:.2f} s\n",
      result.states.evaluated, t.anneal, result.closed_on_the_way, t.close, t.volume, t.prepare);
  fmt::print("written to {}\n", choice.outputs.folder.string());
}

int run_plan(PlanChoice choice) {
  const Scene scene = load_scene(choice.scene);
  const PlanOptions options = understand(choice.planner, *scene.hand);
  require_sound(options, *scene.hand);
  choice.outputs.require_folder(scene.object->name + "-" + scene.hand->name);
  PlanResult result = plan_with_progress(scene, options);
  const GraspFile file = make_grasp_file(scene, object_units(choice.scene), options, std::move(result));
  write_plan_files(scene, file, choice.outputs);
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
  add_output_options(*command, choice->outputs, "out/OBJECT-HAND");
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
