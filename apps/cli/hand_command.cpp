// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/kinematics/eigengrasp_space.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/model_io/hand_check.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/render/image.hpp"
#include "eigengrasp/render/pictures.hpp"

namespace eigengrasp::cli {

namespace {

void list_all_hands() {
  HandReadOptions options;
  options.load_meshes = false;
  for (const NamedModel& m : list_hands()) {
    const HandModel hand = load_hand(m.path, options);
    fmt::print("{:16} {:2} DOF  {:2} eigengrasps  {:2} virtual contacts  {}\n", m.name, hand.n_dof(),
               hand.eigengrasps.size(), hand.virtual_contacts.size(), hand.title);
  }
}

void print_eigengrasps(const HandModel& hand) {
  const EigengraspSpace& space = hand.eigengrasps;
  fmt::print("\n{:24} {:>8}", "eigengrasps", "origin");
  for (int i = 0; i < space.size(); ++i) fmt::print(" {:>8}", fmt::format("e{}", i + 1));
  fmt::print("\n");
  for (int d = 0; d < hand.n_dof(); ++d) {
    fmt::print("{:24} {:8.3f}", hand.dofs[static_cast<std::size_t>(d)].name, space.origin()[d]);
    for (int i = 0; i < space.size(); ++i) fmt::print(" {:8.3f}", space[i].direction[d]);
    fmt::print("\n");
  }
  for (int i = 0; i < space.size(); ++i)
    fmt::print("e{}: {}, amplitude {:.2f} to {:.2f}\n", i + 1, space[i].name, space[i].min, space[i].max);
}

void print_hand(const HandModel& hand) {
  fmt::print("{}: {}\n{}\n", hand.name, hand.title, hand.source.string());
  fmt::print("{} links, {} joints, {} degrees of freedom, {} virtual contacts\n\n", hand.n_links(),
             hand.n_joints(), hand.n_dof(), hand.virtual_contacts.size());
  fmt::print("{:24} {:>8} {:>8} {:>8} {:>10}  {}\n", "degree of freedom", "min", "max", "rest", "closing",
             "type");
  for (const HandDof& d : hand.dofs)
    fmt::print("{:24} {:8.3f} {:8.3f} {:8.3f} {:10.3f}  {}\n", d.name, d.min, d.max, d.rest, d.closing_speed,
               d.type == DofType::breakaway ? "breakaway" : "rigid");
  fmt::print("\n{:24} {:>9} {:>9}  {}\n", "link", "triangles", "mass [g]", "material");
  for (const HandLink& l : hand.links)
    if (!l.mesh.empty())
      fmt::print("{:24} {:9} {:9.1f}  {}{}{}\n", l.name, l.mesh.triangles.size(), 1000.0 * l.mass,
                 l.material.name, l.material.friction ? fmt::format(", mu {}", *l.material.friction) : "",
                 l.material.youngs_modulus ? ", soft" : "");
  print_eigengrasps(hand);
}

struct ShowChoice {
  HandChoice hand;
  bool eigengrasps = false;
  bool contacts = false;
  int tile = 500;
  std::string beside;
  std::filesystem::path png;
};

Image draw_hand(const ShowChoice& choice, const std::shared_ptr<const HandModel>& hand,
                const PictureOptions& options) {
  if (choice.eigengrasps) return eigengrasp_picture(hand, std::max(1, hand->eigengrasps.size()), options);
  if (choice.contacts) return hand_contacts_picture(hand, options);
  if (choice.beside.empty()) return hand_picture(hand, joint_values(*hand, hand->rest_posture()), options);
  HandChoice other;
  other.name = choice.beside;
  const std::vector<std::shared_ptr<const HandModel>> hands = {hand, load_hand_choice(other)};
  return hands_side_by_side(hands, {hand->source.string(), hands[1]->source.string()}, options);
}

void show_hand(const ShowChoice& choice) {
  const auto hand = load_hand_choice(choice.hand);
  if (choice.png.empty() && (choice.eigengrasps || choice.contacts || !choice.beside.empty()))
    fail("--eigengrasps, --contacts and --beside draw a picture; say where with --png FILE");
  if (choice.tile < 16 || choice.tile > 4096) fail("--tile is {}, expected 16 to 4096 pixels", choice.tile);
  if (choice.png.empty()) return print_hand(*hand);
  PictureOptions options;
  options.tile = choice.tile;
  save_png(draw_hand(choice, hand, options), choice.png);
  print_hand(*hand);
  fmt::print("\nwrote {}\n", choice.png.string());
}

int check_given_hand(const HandChoice& choice) {
  const auto hand = load_hand_choice(choice);
  const auto findings = check_hand(*hand);
  bool errors = false;
  for (const HandFinding& f : findings) {
    errors |= f.severity == HandFinding::Severity::error;
    fmt::print("{}: {}\n", severity_name(f.severity), f.sentence);
  }
  fmt::print("{}: {}\n", hand->name,
             findings.empty() ? "nothing to complain about" : fmt::format("{} findings", findings.size()));
  return errors ? nothing_found : success;
}

struct PcaChoice {
  std::filesystem::path recordings;
  std::string valid_column;
  std::vector<std::string> skipped = {"id", "fit_error"};  ///< columns that are no joints
  int components = 2;
  bool yaml = false;
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) {
    while (!cell.empty() && (cell.back() == '\r' || cell.back() == ' ')) cell.pop_back();
    cells.push_back(cell);
  }
  return cells;
}

bool is_number(const std::string& cell, double& value) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

/// The columns of a CSV file that hold numbers in every row.
struct Recordings {
  std::vector<std::string> names;
  Eigen::MatrixXd postures;
};

Recordings read_recordings(const PcaChoice& choice) {
  std::istringstream text(read_text_file(choice.recordings));
  std::string line;
  if (!std::getline(text, line))
    fail("{}: is empty, expected a line of joint names and a line of values a posture",
         choice.recordings.string());
  const auto header = split(line);
  std::vector<std::vector<std::string>> rows;
  std::size_t valid = header.size();
  for (std::size_t c = 0; c < header.size(); ++c)
    if (header[c] == choice.valid_column) valid = c;
  for (int number = 2; std::getline(text, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    auto cells = split(line);
    if (cells.size() != header.size())
      fail_at(choice.recordings, number, "has {} cells, expected {} as in the first line", cells.size(),
              header.size());
    if (valid < header.size() && (cells[valid] == "0" || cells[valid] == "false" || cells[valid] == "False"))
      continue;
    rows.push_back(std::move(cells));
  }
  Recordings r;
  std::vector<std::vector<double>> columns;
  for (std::size_t c = 0; c < header.size(); ++c) {
    const auto& skipped = choice.skipped;
    if (c == valid || std::find(skipped.begin(), skipped.end(), header[c]) != skipped.end()) continue;
    std::vector<double> column(rows.size());
    bool numeric = true;
    for (std::size_t i = 0; i < rows.size() && numeric; ++i) numeric = is_number(rows[i][c], column[i]);
    if (!numeric) continue;
    r.names.push_back(header[c]);
    columns.push_back(std::move(column));
  }
  r.postures.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t i = 0; i < rows.size(); ++i)
      r.postures(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = columns[c][i];
  if (rows.size() < 2 || columns.empty())
    fail("{}: has {} rows with {} columns of numbers, expected at least 2 rows and 1 column",
         choice.recordings.string(), rows.size(), columns.size());
  return r;
}

void print_components(const PcaChoice& choice) {
  const Recordings r = read_recordings(choice);
  const PostureComponents pca = compute_posture_components(r.postures);
  const int n = static_cast<int>(r.names.size());
  fmt::print("# {} postures of {} joints\n# variance explained by the first components:", r.postures.rows(),
             n);
  for (int i = 1; i <= n; ++i) fmt::print(" {:.1f} %", 100.0 * pca.explained(i));
  fmt::print("\neigengrasps:\n  origin: {{");
  for (int j = 0; j < n; ++j)
    fmt::print("{}{}: {:.6f}", j ? ", " : "", r.names[static_cast<std::size_t>(j)], pca.mean[j]);
  fmt::print("}}\n  directions:\n");
  for (int i = 0; i < std::min(choice.components, n); ++i) {
    const double sd = std::sqrt(std::max(0.0, pca.variance[i]));
    fmt::print("    - name: component {}\n      range: [{:.3f}, {:.3f}]\n      vector: {{", i + 1, -2.0 * sd,
               2.0 * sd);
    for (int j = 0; j < n; ++j)
      fmt::print("{}{}: {:.6f}", j ? ", " : "", r.names[static_cast<std::size_t>(j)], pca.directions(j, i));
    fmt::print("}}\n");
  }
}

void add_show(CLI::App& hand) {
  auto choice = std::make_shared<ShowChoice>();
  CLI::App* command = hand.add_subcommand("show", "Print a hand's data; draw it with --png");
  add_graspit_options(*command, choice->hand, "--contact-files");
  command->add_option("name", choice->hand.name, "Name, folder, hand.yaml or GraspIt! XML")->required();
  command->add_flag("--eigengrasps", choice->eigengrasps,
                    "Draw each eigengrasp at its smallest and largest amplitude (Table I)");
  command->add_flag("--contacts", choice->contacts, "Draw the virtual contacts with their normals (Fig. 1)");
  command->add_option("--beside", choice->beside,
                      "Draw this hand too, such as the GraspIt! robot XML of the same hand");
  command->add_option("--png", choice->png, "Picture to write");
  command->add_option("--tile", choice->tile, "Side of a tile [pixel]");
  command->footer("Example:\n  eigengrasp hand show human --eigengrasps --png table1.png");
  command->callback([choice] { show_hand(*choice); });
}

}  // namespace

void add_hand_command(CLI::App& app, int& exit_code) {
  CLI::App* hand = app.add_subcommand("hand", "List, show and check hands; eigengrasps from recordings");
  hand->require_subcommand(1);
  hand->footer(
      "Examples:\n  eigengrasp hand list\n  eigengrasp hand show human --eigengrasps --png table1.png\n"
      "  eigengrasp hand check my-hand\n  eigengrasp hand pca recordings.csv --components 6");
  CLI::App* list = hand->add_subcommand("list", "Known hands");
  list->footer("Example:\n  eigengrasp hand list");
  list->callback([] { list_all_hands(); });
  add_show(*hand);

  auto checked = std::make_shared<HandChoice>();
  CLI::App* check =
      hand->add_subcommand("check", "Say what is wrong with a hand and how to mend it (exit code 1: errors)");
  add_graspit_options(*check, *checked, "--contact-files");
  check->add_option("path", checked->name, "Name, folder, hand.yaml or GraspIt! XML")->required();
  check->footer("Example:\n  eigengrasp hand check my-hand");
  check->callback([checked, &exit_code] { exit_code = check_given_hand(*checked); });

  auto pca = std::make_shared<PcaChoice>();
  pca->valid_column = "valid";
  CLI::App* components =
      hand->add_subcommand("pca", "Eigengrasps of recorded postures, as YAML for a hand.yaml");
  components
      ->add_option("recordings", pca->recordings, "CSV: a line of joint names, then a posture a line [rad]")
      ->required();
  components->add_option("--components", pca->components, "How many to print");
  components
      ->add_option("--skip", pca->skipped, "Columns of numbers that are no joints (default: id,fit_error)")
      ->delimiter(',');
  components->add_option("--valid-column", pca->valid_column,
                         "Rows with 0 or false in this column are left out");
  components->footer("Example:\n  eigengrasp hand pca recordings.csv --components 6");
  components->callback([pca] { print_components(*pca); });
}

}  // namespace eigengrasp::cli
