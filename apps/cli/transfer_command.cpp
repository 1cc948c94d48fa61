// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <cmath>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/plan_options_cli.hpp"
#include "cli/plan_outputs.hpp"
#include "cli/scene_options.hpp"
#include "cli/transfer_files.hpp"
#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"

namespace eigengrasp::cli {

namespace {

struct TransferChoice {
  SceneChoice scene;
  PlannerChoice planner;
  PlanOutputs outputs;
  std::string store = "shipped";
  std::string from_hand;
  std::string distance;
  TransferOptions options;
  bool leave_out = false;
};

/// OBJECT may be one of the store's, which comes in its size there.
const StoredModel* named_in_store(const TransferChoice& choice, const TransferStore& store) {
  std::error_code ec;
  if (!choice.scene.world.empty() || std::filesystem::exists(choice.scene.object, ec)) return nullptr;
  return store.find(choice.scene.object);
}

ObjectModel in_size(ObjectModel object, double scale) {
  if (!std::isfinite(scale) || scale <= 0.0) fail("the scale is {}, expected a positive number", scale);
  return scale == 1.0 ? std::move(object) : rescaled(object, scale);
}

/// Of the store: the object itself, by name or by what its file holds.
std::vector<std::string> same_objects(const Scene& scene, const TransferStore& store) {
  std::vector<std::string> names;
  std::error_code ec;
  const bool has_file = std::filesystem::is_regular_file(scene.object->source, ec);
  const std::string hash = has_file ? content_hash(read_text_file(scene.object->source)) : std::string();
  for (const StoredModel& m : store.models())
    if (m.name == scene.object->name || (has_file && m.content_hash == hash)) names.push_back(m.name);
  return names;
}

TransferOptions understand_transfer(const TransferChoice& choice, const HandModel& hand) {
  TransferOptions options = choice.options;
  if (!choice.distance.empty()) options.distance = parse_neighbor_distance(choice.distance);
  options.plan = understand(choice.planner, hand);
  options.plan.search = SearchKind::transfer;
  options.candidates.threads = options.plan.threads;
  if (!choice.from_hand.empty() && choice.from_hand != choice.scene.hand.name)
    options.from_hand = load_hand_choice({choice.from_hand, {}, {}});
  if (const auto violations = options.validate(hand); !violations.empty()) fail("{}", violations.front());
  return options;
}

void print_neighbors(const TransferResult& result) {
  for (std::size_t i = 0; i < result.neighbors.size(); ++i) {
    const UsedNeighbor& n = result.neighbors[i];
    std::string scales;
    for (const double scale : n.scales) scales += fmt::format(" {:g}", scale);
    fmt::print("{:>3}. {:<20} distance {:.4f}, overlap {:.3f}, scales{}, {} of {} pre-grasps form-closed\n",
               i + 1, n.object, n.distance, n.alignment.overlap, scales.empty() ? " none" : scales,
               result.form_closed[i], n.candidates);
  }
}

void write_transfer_files(const Scene& scene, const TransferStore& store, const TransferOptions& options,
                          const TransferResult& result, const PlanOutputs& outputs) {
  write_file_atomically(outputs.folder / "transfer.json", transfer_json(result, store.store().place()));
  constexpr std::size_t most = 6;
  if (!outputs.pictures || result.plan.grasps.empty()) return;
  const auto& from = options.from_hand ? options.from_hand : scene.hand;
  save_png(transfer_picture(scene, store, result, from, most, options.plan.threads),
           outputs.folder / "pairs.png");
}

int run_transfer(TransferChoice choice) {
  const auto store = open_to_read(choice.store);
  const TransferStore objects(*store);
  ObjectUnits units = object_units(choice.scene);
  if (const StoredModel* model = named_in_store(choice, objects)) {
    choice.scene.loaded_object =
        std::make_shared<const ObjectModel>(in_size(load_stored_object(*model), choice.scene.scale));
    units = {"m", model->rescale * choice.scene.scale};
    if (choice.options.tags.empty()) choice.options.tags = model->tags;
  }
  const Scene scene = load_scene(choice.scene);
  TransferOptions options = understand_transfer(choice, *scene.hand);
  if (choice.leave_out) options.without = same_objects(scene, objects);
  const InterruptGuard guard;
  options.plan.stop = &guard.stop_flag();
  TransferResult result = transfer_grasps(scene, objects, options);
  choice.outputs.require_folder(scene.object->name + "-" + scene.hand->name + "-transfer");
  print_neighbors(result);
  print_grasps(scene, result.plan, choice.outputs);
  const TransferTimings& t = result.timings;
  fmt::print("{:.3f} s: preparation {:.3f} s beside neighbours {:.3f} s, closing and rating {:.3f} s\n",
             t.total, t.prepare, t.neighbors, t.rate);
  write_transfer_files(scene, objects, options, result, choice.outputs);
  const GraspFile file = make_grasp_file(scene, units, options.plan, std::move(result.plan));
  write_plan_files(scene, file, choice.outputs);
  fmt::print("written to {}\n", choice.outputs.folder.string());
  return file.result.status == PlanStatus::found ? success : nothing_found;
}

void add_transfer_options(CLI::App& command, TransferChoice& choice) {
  TransferOptions& o = choice.options;
  PlanOptions& plan = choice.planner.options;
  command.add_option("--store", choice.store, std::string(kStoreToReadHelp) + " (default)");
  command.add_option("--neighbors", o.candidates.neighbors,
                     "Objects of the store to take grasps of (default: 5)");
  command.add_option(
      "--distance", choice.distance,
      "What makes neighbours: zernike (like shape), views (a scan: like a view), class (like tags), random "
      "(default: zernike; a scan of one side: views, if the store has them)");
  command.add_option("--tags", o.tags, "Class of the object, outermost first; for --distance class")
      ->delimiter(',');
  command.add_option("--alignment", o.candidates.alignment,
                     "pca, or pca-icp, which is closer and takes longer (default: pca; a scan of one side: "
                     "pca-icp, by what was seen)");
  command.add_option(
      "--candidates", o.candidates.most,
      "Pre-grasps of a neighbour at a scale, those of the highest epsilon; 0: all (default: 6)");
  command.add_option("--min-epsilon", o.min_epsilon, "Keep grasps whose epsilon is above this (default: 0)");
  command.add_option(
      "--from-hand", choice.from_hand,
      "Take the grasps of another hand: its wrists by the palms' approach frames, its amplitudes "
      "for those of --hand's eigengrasps");
  command.add_flag("--leave-out", choice.leave_out,
                   "Leave the object itself out of the store: what has its name or its file's content");
  command.add_option("--grasps", plan.grasps, "Distinct grasps to keep (default: 20)");
  command.add_option("--time", choice.planner.time, "Time limit of closing and rating, such as 200ms");
  command.add_option("--seed", plan.seed, "Of random neighbours, and of the choice within a class");
  command.add_option("--threads", plan.threads, "0: all; does not change the result");
}

}  // namespace

void add_transfer_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<TransferChoice>();
  CLI::App* command = app.add_subcommand("transfer", "Grasp an object by the stored grasps of like ones");
  command->add_option(
      "object", choice->scene.object,
      "Mesh file, GraspIt! body, shipped object's name, or the name of an object of the store");
  add_scene_options(*command, choice->scene);
  add_transfer_options(*command, *choice);
  add_wrench_options(*command, choice->planner);
  add_output_options(*command, choice->outputs, "out/OBJECT-HAND-transfer");
  command->footer(
      "Needs a store with grasps ('eigengrasp db build') and shape descriptors ('eigengrasp db describe').\n"
      "Writes what 'eigengrasp plan' writes, transfer.json (neighbours and origins), and pairs.png (grasps "
      "on "
      "neighbours and on\nthe object).\n"
      "Examples:\n"
      "  eigengrasp transfer part.stl --units mm --hand human --store sqlite:grasps.db\n"
      "  eigengrasp transfer psb_12 --hand barrett-rubber --store sqlite:grasps.db --leave-out --candidates "
      "0\n"
      "  eigengrasp transfer glass --hand barrett-rubber --from-hand human --store sqlite:grasps.db\n"
      "Exit code: 0 grasps found, 1 none found, 2 bad input.");
  command->callback([choice, &exit_code] {
    choice->planner.iterations_given = true;
    exit_code = run_transfer(*choice);
  });
}

}  // namespace eigengrasp::cli
