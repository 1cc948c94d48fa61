// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include "eigengrasp/experiments/psb_retrieval.hpp"
#include "eigengrasp/render/line_chart.hpp"
#include "experiments/markdown.hpp"
#include "experiments/record_json.hpp"

namespace eigengrasp {

namespace {

using Row = std::vector<std::string>;

std::vector<double> five(const RetrievalMeasures& m) {
  return {m.nearest_neighbor, m.first_tier, m.second_tier, m.e_measure, m.dcg};
}

std::string percent(double share) {
  return fmt::format("{:.1f}", 100.0 * share);
}

Row row_text(const RetrievalRow& row) {
  Row cells{row.name};
  for (const double value : five(row.measures)) cells.push_back(percent(value));
  cells.push_back(fmt::format("{} / {}", row.moments, row.voxels));
  cells.push_back(fmt::format("{}", row.failed));
  cells.push_back(fmt::format("{:.0f} ms", 1e3 * row.seconds));
  return cells;
}

std::string half_table(const PsbRetrieval& result, bool test) {
  std::vector<Row> rows;
  for (const RetrievalRow& row : result.rows)
    if (row.test == test) rows.push_back(row_text(row));
  if (test) {
    Row anchor{"spherical harmonics descriptor (Shilane et al. 2004)"};
    for (const double value : kSphericalHarmonics) anchor.push_back(percent(value));
    anchor.insert(anchor.end(), {"", "", ""});
    rows.push_back(anchor);
  }
  return markdown_table({"%", "nearest neighbour", "first tier", "second tier", "E-measure", "DCG",
                         "moments / voxels", "failed", "time of one"},
                        rows);
}

std::string verdict(bool met) {
  return met ? "met" : "**not met**";
}

std::string targets_table(const PsbRetrieval& result) {
  const std::vector<double> ours = five(result.rows.front().measures);
  bool above = true;
  for (std::size_t i = 0; i < ours.size(); ++i) above = above && ours[i] > kSphericalHarmonics[i];
  const SearchTimes& s = result.search;
  std::vector<Row> rows{{"retrieval on the test half", "all five above the spherical harmonics descriptor",
                         above ? "all five" : "not all", verdict(above)},
                        {fmt::format("exact search over {} shapes", s.exact_size), "<= 1 ms",
                         fmt::format("{:.2f} ms", 1e3 * s.exact_seconds), verdict(s.exact_seconds <= 1e-3)}};
  if (s.index_size > 0) {
    constexpr double least_recall = 0.95;
    const SearchTimes::Width* best = nullptr;
    for (const auto& width : s.widths)
      if (!best && width.recall >= least_recall) best = &width;
    const SearchTimes::Width& shown = best ? *best : s.widths.back();
    rows.push_back({fmt::format("index over {} shapes", s.index_size), "<= 2 ms at recall >= 0.95",
                    fmt::format("{:.2f} ms at {:.3f}", 1e3 * shown.seconds, shown.recall),
                    verdict(best && best->seconds <= 2e-3)});
  }
  return markdown_table({"what", "target", "here", ""}, rows);
}

std::string index_text(const SearchTimes& s) {
  if (s.index_size == 0) return "";
  std::vector<Row> rows;
  for (const auto& w : s.widths)
    rows.push_back({fmt::format("{}", w.width), fmt::format("{:.2f} ms", 1e3 * w.seconds),
                    fmt::format("{:.4f}", w.recall)});
  return fmt::format(
             "\n## Index\n\n{} descriptors, each a random mixture of three of the benchmark's; 200 queries "
             "made "
             "alike, for the 25 nearest. Made in {:.0f} s.\n\n",
             s.index_size, s.build_seconds) +
         markdown_table({"width of the search", "time of a query", "recall"}, rows);
}

LineChart chart_of(const PsbRetrieval& result) {
  LineChart chart;
  chart.title = "3-D Zernike descriptors, Princeton Shape Benchmark, test half";
  chart.x_name = "recall";
  chart.y_name = "precision";
  for (const RetrievalRow& row : result.rows) {
    if (!row.test) continue;
    LineChart::Curve curve;
    curve.name = row.name;
    curve.dashed = !row.name.ends_with("(default)");
    const auto& precision = row.measures.precision;
    for (std::size_t i = 0; i < precision.size(); ++i)
      curve.points.emplace_back(static_cast<double>(i + 1) / static_cast<double>(precision.size()),
                                precision[i]);
    chart.curves.push_back(curve);
  }
  return chart;
}

}  // namespace

std::string psb_retrieval_markdown(const PsbRetrieval& result, const ExperimentRecord& record) {
  std::string page =
      "# Shapes by their neighbours: 3-D Zernike descriptors on the Princeton Shape Benchmark\n\n";
  page += fmt::format("Made by `{}`\nwith eigengrasp {} on {}.\n\n", record.command, record.version,
                      describe(record.machine));
  page += targets_table(result);
  page += fmt::format(
      "\nEvery shape of a half of the base classification is looked up among all others of that half ({} and "
      "{} "
      "queries; {} classified models are missing from the data). Means over the queries in %, defined as in "
      "the "
      "benchmark's paper and program. The weights of the invariants were learned from the training half "
      "alone "
      "([how](../theory/zernike.md)). A model that cannot be described in a row's way counts as unlike all "
      "others. Times are medians of a thread's processor time for a descriptor.\n\n",
      result.rows.front().measures.queries, result.rows.back().measures.queries, result.absent.size());
  page += "## Test half\n\n" + half_table(result, true);
  page +=
      "\n![Precision over recall](psb-retrieval/precision-recall.png)\n\nPrecision over recall "
      "([SVG](psb-retrieval/precision-recall.svg)).\n";
  page += "\n## Training half\n\n" + half_table(result, false);
  return page + index_text(result.search);
}

std::string psb_retrieval_json(const PsbRetrieval& result, const ExperimentRecord& record) {
  OrderedJson json{{"format", "eigengrasp-psb-retrieval"}, {"version", 1}};
  json.update(record_json(record));
  json["absent"] = result.absent;
  json["rows"] = OrderedJson::array();
  for (const RetrievalRow& row : result.rows) {
    const RetrievalMeasures& m = row.measures;
    json["rows"].push_back({{"name", row.name},
                            {"half", row.test ? "test" : "train"},
                            {"queries", m.queries},
                            {"nearest_neighbor", m.nearest_neighbor},
                            {"first_tier", m.first_tier},
                            {"second_tier", m.second_tier},
                            {"e_measure", m.e_measure},
                            {"dcg", m.dcg},
                            {"precision", m.precision},
                            {"by_moments", row.moments},
                            {"by_voxels", row.voxels},
                            {"failed", row.failed},
                            {"seconds", row.seconds}});
  }
  const SearchTimes& s = result.search;
  json["exact_search"] = {{"size", s.exact_size}, {"seconds", s.exact_seconds}};
  if (s.index_size > 0) {
    json["index"] = {{"size", s.index_size}, {"build_seconds", s.build_seconds}};
    for (const auto& w : s.widths)
      json["index"]["widths"].push_back({{"width", w.width}, {"seconds", w.seconds}, {"recall", w.recall}});
  }
  return pretty_text(json);
}

std::string psb_retrieval_svg(const PsbRetrieval& result) {
  return chart_svg(chart_of(result));
}

Image psb_retrieval_picture(const PsbRetrieval& result) {
  return draw_chart(chart_of(result));
}

}  // namespace eigengrasp
