// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include "eigengrasp/experiments/table3_report.hpp"
#include "experiments/markdown.hpp"
#include "experiments/record_json.hpp"

namespace eigengrasp {

Table3 make_table3(GraspStore& store) {
  return {compute_statistics(store), store.counts().scaled_models};
}

std::int64_t paper_grasps(const std::string& hand) {
  return hand == "barrett-metal" ? 25585 : hand == "barrett-rubber" ? 132421 : hand == "human" ? 80731 : 0;
}

namespace {

constexpr std::array shares{0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0};

double per(double sum, std::int64_t n) {
  return n > 0 ? sum / static_cast<double>(n) : 0.0;
}

std::string paper_text(const std::string& hand) {
  const std::int64_t n = paper_grasps(hand);
  return n > 0 ? fmt::format("{} ({:.1f} a unit)", n, per(static_cast<double>(n), kPaperUnits)) : "-";
}

std::string counts_table(const Table3& table) {
  std::vector<std::vector<std::string>> rows;
  for (const HandStatistics& h : table.statistics.hands)
    rows.push_back({h.hand, fmt::format("{} of {}", h.done + h.failed, h.units),
                    fmt::format("**{}** ({:.1f} a unit)", h.form_closed,
                                per(static_cast<double>(h.form_closed), h.done + h.failed)),
                    paper_text(h.hand), fmt::format("{}", h.failed),
                    fmt::format("{:.2f}", per(h.seconds, h.done + h.failed)),
                    fmt::format("{:.2f}", h.median_seconds)});
  return markdown_table(
      {"hand", "units", "form-closed grasps", "paper", "units without", "core-seconds a unit", "median"},
      rows);
}

std::string epsilon_table(const Table3& table) {
  std::vector<std::string> headings{"hand"};
  for (const double share : shares) headings.push_back(fmt::format("{:.0f} %", 100.0 * share));
  std::vector<std::vector<std::string>> rows;
  for (const HandStatistics& h : table.statistics.hands) {
    rows.push_back({h.hand});
    for (const double share : shares)
      rows.back().push_back(fmt::format("{:.4f}", quantile(h.epsilons, share)));
  }
  return markdown_table(headings, rows);
}

std::string failures_text(const Table3& table) {
  const StoreStatistics& s = table.statistics;
  if (s.failures.empty()) return "Every unit that has ended has a grasp.\n";
  std::vector<std::vector<std::string>> rows;
  for (const FailureStatistics& f : s.failures)
    rows.push_back(
        {f.kind, fmt::format("{}", f.units),
         fmt::format("{} at {} with {}: {}", f.example.object, f.example.scale, f.example.hand, f.reason)});
  return markdown_table({"why", "units", "such as"}, rows);
}

OrderedJson hand_json(const HandStatistics& h) {
  OrderedJson epsilons = OrderedJson::object();
  for (const double share : shares) epsilons[fmt::format("{:g}", share)] = quantile(h.epsilons, share);
  return {{"hand", h.hand},
          {"units", h.units},
          {"done", h.done},
          {"failed", h.failed},
          {"grasps", h.grasps},
          {"form_closed", h.form_closed},
          {"paper", paper_grasps(h.hand)},
          {"core_seconds", h.seconds},
          {"median_core_seconds", h.median_seconds},
          {"epsilon_quantiles", epsilons}};
}

}  // namespace

std::string table3_markdown(const Table3& table, const ExperimentRecord& record,
                            const std::vector<ResultPicture>& pictures) {
  const StoreStatistics& s = table.statistics;
  double seconds = 0.0;
  std::int64_t grasps = 0;
  for (const HandStatistics& h : s.hands) {
    seconds += h.seconds;
    grasps += h.form_closed;
  }
  std::string text = fmt::format(
      "# The grasp database\n\nTable III of the paper: form-closure grasps of {} objects at {} sizes in all. "
      "The "
      "paper's has 238,737, of 7,256\nobjects at four sizes, made in a month on six multi-core "
      "computers.\n\n{}\n"
      "{} grasps in {:.2f} core-hours, {:.0f} a core-second; {} objects without any grasp; {} units ended at "
      "the time limit.\n",
      s.objects, table.objects_at_scales, counts_table(table), grasps, seconds / 3600.0,
      static_cast<double>(grasps) / std::max(seconds, 1e-9), s.objects_without_grasps, s.limited);
  text += fmt::format("\n## Units without grasps\n{}", failures_text(table));
  text += fmt::format("\n## Epsilon\nOf the form-closed grasps, below which a share of them lies.\n\n{}",
                      epsilon_table(table));
  if (!pictures.empty()) text += "\n## Pictures\n";
  for (const ResultPicture& p : pictures)
    text += fmt::format("{}\n\n![{}]({})\n\n", p.caption, p.caption, p.file);
  text += fmt::format(
      "\n## How it was made\n`{}`, eigengrasp {}, {}. Core-seconds hold the share of reading and "
      "preparing the object.\n",
      record.command, record.version, describe(record.machine));
  return text;
}

std::string table3_json(const Table3& table, const ExperimentRecord& record) {
  OrderedJson json = record_json(record);
  json["objects"] = table.statistics.objects;
  json["objects_at_scales"] = table.objects_at_scales;
  json["objects_without_grasps"] = table.statistics.objects_without_grasps;
  json["units_at_time_limit"] = table.statistics.limited;
  json["hands"] = OrderedJson::array();
  for (const HandStatistics& h : table.statistics.hands) json["hands"].push_back(hand_json(h));
  json["failures"] = OrderedJson::array();
  for (const FailureStatistics& f : table.statistics.failures)
    json["failures"].push_back({{"kind", f.kind}, {"units", f.units}, {"example", f.reason}});
  return json.dump(2) + "\n";
}

}  // namespace eigengrasp
