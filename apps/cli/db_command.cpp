// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "cli/add_objects.hpp"
#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/interrupt_guard.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/database/store_copy.hpp"
#include "eigengrasp/jobs/grasp_file_import.hpp"

namespace eigengrasp::cli {

namespace {

/// What the commands are told.
struct DbChoice {
  std::string store, other, object, hand, tag;
  double scale = 0.0;  ///< 0: all
};

void print_info(const DbChoice& choice) {
  const auto store = open_to_read(choice.store);
  const StoreCounts c = store->counts();
  fmt::print("{}\n", store->place());
  fmt::print("objects     {}, with scales {}\n", c.models, c.scaled_models);
  fmt::print("hands       {}\n", c.hands);
  fmt::print("grasps      {}\n", c.grasps);
  for (const auto& [hand, n] : c.grasps_by_hand) fmt::print("  {:<20} {:>9}\n", hand, n);
  for (const GraspSource& s : store->sources()) fmt::print("source      {}: {}\n", s.name, s.description);
  fmt::print("units       {} done, {} failed, {} claimed, {} waiting\n", c.done, c.failed, c.claimed,
             c.waiting);
  fmt::print("descriptors {}\nneighbours  {}\nalignments  {}\n", c.descriptors, c.neighbors, c.alignments);
}

void print_list(const DbChoice& choice) {
  const auto store = open_to_read(choice.store);
  for (const StoredModel& m : store->models()) {
    if (!choice.tag.empty() && std::find(m.tags.begin(), m.tags.end(), choice.tag) == m.tags.end()) continue;
    fmt::print("{:<20} rescale {:<10.4g} radius {:6.1f} mm  scales {}  {}\n", m.name, m.rescale,
               1000.0 * m.approximate_radius, fmt::join(m.scales, " "), fmt::join(m.tags, ", "));
  }
}

void print_grasps(const DbChoice& choice, GraspStore& store, const std::string& hand) {
  for (const StoredGrasp& s : store.grasps(choice.object, hand)) {
    const Grasp& g = s.grasp;
    if (choice.scale > 0.0 && g.object_scale != choice.scale) continue;
    fmt::print("{:>8} {:<16} {:>5} {:>9.4f} {:>10.3g} {:>8} {:>8}  {}\n", s.id, hand, g.object_scale,
               g.epsilon, g.volume, g.contacts.size(), g.form_closure ? "yes" : "no", s.source);
  }
}

void print_show(const DbChoice& choice) {
  const auto store = open_to_read(choice.store);
  const auto models = store->models();
  const auto model = std::find_if(models.begin(), models.end(),
                                  [&](const StoredModel& m) { return m.name == choice.object; });
  if (model == models.end())
    fail("{}: holds no object '{}'; 'eigengrasp db list' names those it holds", store->place(),
         choice.object);
  fmt::print("{}: {}\n", model->name, model->geometry_path);
  fmt::print("rescale {:.6g}, approximate radius {:.1f} mm, content {}\n", model->rescale,
             1000.0 * model->approximate_radius, model->content_hash);
  for (const StoredUnit& u : store->units())
    if (u.key.object == choice.object && u.state == UnitState::failed &&
        (choice.hand.empty() || u.key.hand == choice.hand))
      fmt::print("failed at scale {} with {}: {}\n", u.key.scale, u.key.hand, u.reason);
  fmt::print("{:>8} {:<16} {:>5} {:>9} {:>10} {:>8} {:>8}  {}\n", "id", "hand", "scale", "epsilon", "volume",
             "contacts", "closure", "source");
  if (!choice.hand.empty()) return print_grasps(choice, *store, choice.hand);
  for (const StoredHand& h : store->hands()) print_grasps(choice, *store, h.name);
}

void copy(const std::string& from, const std::string& to) {
  if (from == to) fail("'{}' is both the source and the target, expected two stores", from);
  const auto source = open_to_read(from);
  const auto target = open_to_write(to);
  const CopyReport r = copy_store(*source, *target);
  fmt::print("{}: {} grasps, {} objects, {} hands and {} units are new", target->place(), r.grasps, r.models,
             r.hands, r.units);
  if (r.kept_units > 0) fmt::print("; {} units with an outcome stayed as they were", r.kept_units);
  fmt::print("\n");
}

/// What 'plan' wrote, or another store.
void import_into(const std::string& address, const std::string& from) {
  std::error_code ec;
  if (!from.ends_with(".json") || !std::filesystem::is_regular_file(from, ec)) return copy(from, address);
  const GraspFile file = load_grasps(from);
  const auto store = open_to_write(address);
  const std::size_t n = import_grasp_file(file, *store);
  fmt::print("{}: {} grasps of {} at scale {} with {} are new\n", store->place(), n, file.object.name,
             file.object.scale, file.hand.name);
}

int run_add_objects(const AddObjectsChoice& choice) {
  const InterruptGuard guard;
  const AddObjectsReport r = add_objects(choice, guard.stop_flag());
  for (const std::string& sentence : r.bad) warn(sentence + "; left out");
  if (!r.absent.empty()) warn(fmt::format("classified, but without a mesh: {}", fmt::join(r.absent, ", ")));
  fmt::print("{}: {} objects are new, {} were there, {} were left out, {} have no mesh\n", r.place, r.added,
             r.there, r.bad.size(), r.absent.size());
  if (r.stopped) fmt::print(stderr, "eigengrasp: stopped; the same command goes on\n");
  return r.stopped ? nothing_found : success;
}

CLI::App* add_part(CLI::App& db, DbChoice& choice, const std::string& name, const std::string& help,
                   const char* store_help = kStoreToReadHelp) {
  CLI::App* command = db.add_subcommand(name, help);
  command->add_option("store", choice.store, store_help)->required();
  return command;
}

void add_reading(CLI::App& db, const std::shared_ptr<DbChoice>& choice) {
  CLI::App* info = add_part(db, *choice, "info", "What a store holds, in numbers");
  info->footer("Example:\n  eigengrasp db info sqlite:grasps.db");
  info->callback([choice] { print_info(*choice); });

  CLI::App* list = add_part(db, *choice, "list", "The objects of a store");
  list->add_option("--tag", choice->tag, "Only objects that have this tag");
  list->footer("Example:\n  eigengrasp db list sqlite:grasps.db --tag aircraft");
  list->callback([choice] { print_list(*choice); });

  CLI::App* show = add_part(db, *choice, "show", "The grasps of an object");
  show->add_option("object", choice->object, "Name of an object of the store")->required();
  show->add_option("--hand", choice->hand, "Only grasps with this hand");
  show->add_option("--scale", choice->scale, "Only grasps at this scale")->check(CLI::PositiveNumber);
  show->footer("Example:\n  eigengrasp db show sqlite:grasps.db psb_12 --hand human --scale 1.25");
  show->callback([choice] { print_show(*choice); });
}

void add_copying(CLI::App& db, const std::shared_ptr<DbChoice>& choice) {
  const std::string rule =
      "What the target has stays as it is, so that a copy that was cut short goes on when it is run again.\n";
  CLI::App* out = add_part(db, *choice, "export", "Copy a store into another one");
  out->add_option("target", choice->other, "Store to write to: as STORE; made where it is missing")
      ->required();
  out->footer(rule + "Example:\n  eigengrasp db export sqlite:grasps.db text:grasps");
  out->callback([choice] { copy(choice->store, choice->other); });

  CLI::App* in =
      add_part(db, *choice, "import",
               "Copy another store, or a grasps.json, into this one; made where missing", kStoreHelp);
  in->add_option("source", choice->other,
                 "Store to read from: as STORE; or a grasps.json of 'eigengrasp plan'")
      ->required();
  in->footer(rule +
             "Examples:\n"
             "  eigengrasp db import postgresql://me@localhost/grasps text:grasps\n"
             "  eigengrasp db import sqlite:grasps.db out/glass-human/grasps.json");
  in->callback([choice] { import_into(choice->store, choice->other); });
}

void add_adding(CLI::App& db, int& exit_code) {
  auto choice = std::make_shared<AddObjectsChoice>();
  CLI::App* add =
      db.add_subcommand("add-objects", "Add a folder of meshes to a store, which is made where missing");
  add->add_option("store", choice->store, kStoreHelp)->required();
  add->add_option("folder", choice->folder, "Folder of meshes; folders in it are looked through");
  add->add_flag("--library", choice->library,
                "The shipped objects instead of a folder; the store names them, so that it is good anywhere");
  add->add_option("--units", choice->units, "Of the meshes: m, cm, mm, in (IV and WRL: mm, else m)");
  add->add_flag("--psb", choice->psb,
                "The Princeton Shape Benchmark in its own layout: names psb_N, classes as tags, no units");
  add->add_flag("--keep-size", choice->keep_size, "Do not rescale objects to a size that hands can grasp");
  add->add_option("--scales", choice->scales,
                  "Scales to grasp objects at, ascending (default: 0.75,1,1.25,1.5)")
      ->delimiter(',');
  add->add_option("--thumbnails", choice->thumbnails,
                  "Folder for a small picture of each object (default: none)");
  add->add_option("--threads", choice->threads, "Default: all");
  add->footer(
      "An object is rescaled where the middle side of its box is not 1 to 15 cm or the longest not 3 to 40 "
      "cm, and\n"
      "always with --psb: the middle side becomes 7 cm, but the longest no more than 25 cm. The factor is "
      "stored.\n"
      "Bad meshes and absent models are named on stderr and left out.\n"
      "Examples:\n"
      "  eigengrasp db add-objects sqlite:grasps.db meshes --units mm\n"
      "  eigengrasp db add-objects postgresql://me@localhost/grasps psb_v1 --psb\n"
      "Exit code: 0, 1 stopped by Ctrl-C (what was added stays), 2 bad input.");
  add->callback([choice, &exit_code] { exit_code = run_add_objects(*choice); });
}

}  // namespace

void add_db_command(CLI::App& app, int& exit_code) {
  CLI::App* db =
      app.add_subcommand("db", "Stores of grasps: adding objects, building, looking, verifying, copying");
  db->require_subcommand(1);
  db->footer(
      "A STORE is sqlite:FILE, text:FOLDER or postgresql://USER:PASSWORD@HOST/DATABASE; 'shipped' can be "
      "read.\n"
      "Examples:\n"
      "  eigengrasp db add-objects sqlite:grasps.db meshes --units mm\n"
      "  eigengrasp db build sqlite:grasps.db --hands human,barrett-rubber\n"
      "  eigengrasp db info sqlite:grasps.db\n"
      "  eigengrasp db show shipped glass --hand human\n"
      "  eigengrasp db export sqlite:grasps.db text:grasps");
  auto choice = std::make_shared<DbChoice>();
  add_adding(*db, exit_code);
  add_db_build(*db, exit_code);
  add_db_status(*db);
  add_db_stats(*db);
  add_db_verify(*db, exit_code);
  add_db_describe(*db, exit_code);
  add_reading(*db, choice);
  add_copying(*db, choice);
}

}  // namespace eigengrasp::cli
