// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/db_parts.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/experiments/table3_report.hpp"

namespace eigengrasp::cli {

namespace {

struct Table3Choice {
  std::string store;
  std::filesystem::path out = "docs/results";
  int threads = 0;
  bool pictures = true;
};

/// Of the store, as far as they are known by name.
std::vector<std::shared_ptr<const HandModel>> known_hands(GraspStore& store) {
  std::vector<std::shared_ptr<const HandModel>> hands;
  for (const StoredHand& h : store.hands()) {
    try {
      hands.push_back(load_hand_choice({h.name, {}, {}}));
    } catch (const Error& e) {
      warn(fmt::format("no pictures with the hand {}: {}", h.name, e.what()));
    }
  }
  return hands;
}

void reproduce_table3(const Table3Choice& choice) {
  const auto store = open_to_read(choice.store);
  if (store->counts().grasps == 0)
    fail("{}: holds no grasps; 'eigengrasp db build' plans them", store->place());
  require_writable_folder(choice.out);
  const Table3 table = make_table3(*store);
  std::vector<ResultPicture> pictures;
  if (choice.pictures) pictures = table3_pictures(*store, known_hands(*store), choice.threads);
  const ExperimentRecord record = make_record("eigengrasp reproduce table3 STORE");
  const std::string markdown = table3_markdown(table, record, pictures);
  for (const ResultPicture& picture : pictures) save_png(picture.image, choice.out / picture.file);
  write_file_atomically(choice.out / "grasp-database.json", table3_json(table, record));
  write_file_atomically(choice.out / "grasp-database.md", markdown);
  for (const HandStatistics& h : table.statistics.hands)
    fmt::print("{:<16} {:>8} form-closed grasps of {} units; the paper {}\n", h.hand, h.form_closed,
               h.done + h.failed, paper_grasps(h.hand));
  fmt::print("written to {}\n", (choice.out / "grasp-database.md").string());
}

}  // namespace

void add_reproduce_table3(CLI::App& reproduce) {
  auto choice = std::make_shared<Table3Choice>();
  CLI::App* table3 =
      reproduce.add_subcommand("table3", "Table III: the grasp database, from a store that was built");
  table3->add_option("store", choice->store, kStoreToReadHelp)->required();
  table3->add_option("--out", choice->out, "Folder for the results")->capture_default_str();
  table3->add_option("--threads", choice->threads, "0: all");
  table3->add_flag("!--no-pictures", choice->pictures, "No pictures");
  table3->footer(
      "Writes grasp-database.md, grasp-database.json and the folder grasp-database with pictures.\n"
      "Example:\n  eigengrasp reproduce table3 sqlite:grasps.db --out trial");
  table3->callback([choice] { reproduce_table3(*choice); });
}

}  // namespace eigengrasp::cli
