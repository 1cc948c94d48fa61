// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <cctype>

#include "eigengrasp/experiments/reference_figures.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "eigengrasp/experiments/table2_report.hpp"
#include "experiments/markdown.hpp"
#include "experiments/table2_text.hpp"

namespace eigengrasp {

const char* title_of(PaperHand hand) {
  constexpr std::array titles{"Barrett", "DLR", "Robonaut", "human"};
  return titles.at(static_cast<std::size_t>(hand));
}

const char* title_of(SearchKind search) {
  return search == SearchKind::paper ? "the paper's search" : "our search";
}

const char* title_of(FrictionCase friction) {
  return friction == FrictionCase::one ? "mu = 1" : "materials of the models";
}

std::string title_of(const Table2Part& part) {
  return fmt::format("{}, {}", title_of(part.search), title_of(part.friction));
}

namespace {

std::string capitalised(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

using Reference = double (*)(PaperHand, PaperObject);

std::string cell_text(const Table2Cell& cell, int grasps) {
  const double tested = mean(cell.tested());
  std::string text = fmt::format("{:.1f}", mean(cell.form_closed()));
  if (cell.runs.size() > 1) text += fmt::format(" ± {:.1f}", standard_deviation(cell.form_closed()));
  if (tested < grasps) text += fmt::format(" of {:g}", tested);
  return text;
}

std::vector<std::string> own_row(const Table2& table, const Table2Part& part, PaperHand hand) {
  std::vector<std::string> row{fmt::format("**{}**", title_of(hand))};
  std::vector<double> means;
  for (const PaperObject object : table.options.objects) {
    const Table2Cell& cell = part.cell(hand, object);
    row.push_back(fmt::format("**{}**", cell_text(cell, table.options.grasps)));
    means.push_back(mean(cell.form_closed()));
  }
  row.push_back(fmt::format("**{:.1f}**", mean(means)));
  return row;
}

std::vector<std::string> reference_row(const Table2& table, PaperHand hand, Reference reference,
                                       const char* whose) {
  std::vector<std::string> row{whose};
  std::vector<double> figures;
  for (const PaperObject object : table.options.objects) {
    figures.push_back(reference(hand, object));
    row.push_back(fmt::format("{:.1f}", figures.back()));
  }
  row.push_back(fmt::format("{:.1f}", mean(figures)));
  return row;
}

double mean_of_reference(const Table2& table, Reference reference) {
  std::vector<double> figures;
  for (const PaperHand hand : table.options.hands)
    for (const PaperObject object : table.options.objects) figures.push_back(reference(hand, object));
  return mean(figures);
}

std::string part_text(const Table2& table, const Table2Part& part) {
  std::vector<std::string> headings{"hand"};
  for (const PaperObject object : table.options.objects) headings.emplace_back(name_of(object));
  headings.emplace_back("mean");
  std::vector<std::vector<std::string>> rows;
  const bool materials = part.friction == FrictionCase::materials;
  for (const PaperHand hand : table.options.hands) {
    rows.push_back(own_row(table, part, hand));
    rows.push_back(reference_row(table, hand, paper_form_closed, "paper"));
    if (materials) rows.push_back(reference_row(table, hand, graspit_form_closed, "GraspIt!"));
  }
  std::string text =
      fmt::format("## {}\n\n{}\n", capitalised(title_of(part)), markdown_table(headings, rows));
  text += fmt::format("Mean over the {} cells: **{:.1f}**; paper {:.1f}", part.cells.size(),
                      part.mean_form_closed(), mean_of_reference(table, paper_form_closed));
  if (materials) text += fmt::format("; GraspIt! {:.1f}", mean_of_reference(table, graspit_form_closed));
  return text + ".\n\n";
}

std::string time_row_number(const Table2Part& part, double PlanTimings::*time) {
  std::vector<double> seconds;
  for (const Table2Cell& cell : part.cells)
    for (const Table2Run& run : cell.runs) seconds.push_back(run.timings.*time);
  return fmt::format("{:.3f}", median(seconds));
}

std::string time_text(const Table2& table) {
  std::vector<std::vector<std::string>> rows;
  for (const Table2Part& part : table.parts)
    rows.push_back({title_of(part), time_row_number(part, &PlanTimings::prepare),
                    time_row_number(part, &PlanTimings::anneal), time_row_number(part, &PlanTimings::close),
                    time_row_number(part, &PlanTimings::total)});
  return fmt::format(
      "## Time of a run\n\nMedian over all runs [s]{}. The paper: 162 s (2.13 GHz Core 2); GraspIt! on a "
      "two-core Xeon virtual machine: 13-58 s.\n\n{}\n",
      table.options.cache ? "; what is made of the meshes comes from the cache but for the first time" : "",
      markdown_table({"runs", "prepare", "search", "close and rate", "total"}, rows));
}

std::string target_text(const Table2& table) {
  const auto targets = check_targets(table);
  if (targets.empty()) return {};
  std::vector<std::vector<std::string>> rows;
  for (const Table2Target& target : targets)
    rows.push_back({target.text, target.measured, target.met ? "met" : "**not met**"});
  return "## Targets\n\n" + markdown_table({"target", "measured", ""}, rows) + "\n";
}

std::string introduction(const Table2& table, const ExperimentRecord& record) {
  const Table2Options& o = table.options;
  const std::string counts =
      o.seeds > 1 ? fmt::format("mean ± standard deviation over the seeds 1 to {}", o.seeds) : "of seed 1";
  std::string text = fmt::format(
      "# Table II of the paper\n\nMade by `{}` (do not edit). Form-closed grasps (epsilon >= 1e-6, 8-edge "
      "cones, L1) among the best {} distinct pre-grasps of {} states, closed and rated: {}. Where fewer "
      "than {} pre-grasps were tested, \"of\" says how many.\n\n",
      record.command, o.grasps, o.iterations, counts, o.grasps);
  text += o.models.shipped()
              ? "Hands and objects: those of this program (`barrett-metal`, `dlr`, `robonaut`, `human`), "
                "which are like the paper's in kinematics and size, not in shape; the figures beside ours "
                "are of the paper's.\n\n"
              : "Hands and objects: GraspIt!'s own, with which the paper was made (Barrett, DLR, Robonaut "
                "with 13 degrees of freedom, human with 20; ashtray, shoe_1741, glass, flask, phone, "
                "p51).\n\n";
  text +=
      "\"paper\" is the paper's Table II; it does not say which friction it used. \"GraspIt!\" is GraspIt! "
      "itself with its own models and materials, 40,000 steps, hulls corrected, mostly 5 seeds. \"The "
      "paper's search\" is one chain of simulated annealing (`--search paper`), \"our search\" the default "
      "(`--search staged`). The paper's search closes the pre-grasps of lowest energy, once, at the end. "
      "Ours closes "
      "more of them than it keeps on the way and in part after the palm has moved "
      "up to the "
      "object, and keeps those that close: its figures say how many distinct form-closed grasps of the 20 "
      "wanted the "
      "budget of states yields.\n\n";
  return text + fmt::format("eigengrasp {}; {}.\n\n", record.version, describe(record.machine));
}

}  // namespace

std::string table2_markdown(const Table2& table, const ExperimentRecord& record,
                            const std::vector<ResultPicture>& pictures) {
  std::string text = introduction(table, record) + target_text(table);
  for (const Table2Part& part : table.parts) text += part_text(table, part);
  text += time_text(table);
  if (!pictures.empty()) text += "## Pictures\n\n";
  for (const ResultPicture& picture : pictures)
    text += fmt::format("![{}]({})\n\n{}.\n\n", picture.caption, picture.file, picture.caption);
  text.pop_back();  // one line end is enough
  return text;
}

}  // namespace eigengrasp
