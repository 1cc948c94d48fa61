// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eigengrasp/experiments/figure12.hpp"
#include "eigengrasp/render/line_chart.hpp"
#include "experiments/markdown.hpp"
#include "experiments/record_json.hpp"

namespace eigengrasp {

namespace {

using Row = std::vector<std::string>;

constexpr std::array<const char*, 4> kTitles = {"neighbours of the class", "Zernike neighbours",
                                                "random neighbours", "eigengrasp planner"};
constexpr std::size_t kClass = 0, kZernike = 1, kRandom = 2, kPlanner = 3;
constexpr std::array<int, 9> kShownRanks = {1, 2, 5, 10, 15, 20, 25, 50, 100};
constexpr std::size_t kChartRanks = 50;

std::string verdict(bool met) {
  return met ? "yes" : "no";
}

double at(const Figure12Curve& curve, int rank) {
  return curve.epsilon[static_cast<std::size_t>(rank) - 1];
}

/// Over the ranks 1 to n.
double mean_of(const Figure12Curve& curve, int n) {
  double sum = 0.0;
  for (int i = 1; i <= n; ++i) sum += at(curve, i);
  return sum / n;
}

/// The first rank from which on the curve is above the other one up to rank 25; 0 where there is none.
int above_from(const Figure12Curve& curve, const Figure12Curve& other) {
  int from = 0;
  for (int n = 25; n >= 1 && at(curve, n) > at(other, n); --n) from = n;
  return from;
}

std::string statements(const Figure12& result) {
  std::vector<Row> rows;
  for (std::size_t h = 0; h < result.hands.size(); ++h) {
    const auto& c = result.curves[h];
    const double ratio = mean_of(c[kZernike], 25) / std::max(mean_of(c[kClass], 25), 1e-12);
    rows.push_back({result.hands[h], "Zernike is about equal to the class (ranks 1 to 25)",
                    fmt::format("{:.0f} % of it", 100.0 * ratio), verdict(std::abs(ratio - 1.0) < 0.1)});
    const double over = mean_of(c[kZernike], 25) / std::max(mean_of(c[kRandom], 25), 1e-12);
    rows.push_back({result.hands[h], "Zernike is above random (ranks 1 to 25)",
                    fmt::format("{:.0f} % of it", 100.0 * over), verdict(over > 1.0)});
    const int from = above_from(c[kZernike], c[kPlanner]);
    rows.push_back({result.hands[h], "Zernike is above the planner after the first few",
                    from > 0 ? fmt::format("from rank {} on", from) : "it is not",
                    verdict(from > 0 && from <= 10)});
    rows.push_back({result.hands[h], "first grasp at least the planner's",
                    fmt::format("{:.4f} and {:.4f}", at(c[kZernike], 1), at(c[kPlanner], 1)),
                    verdict(at(c[kZernike], 1) >= at(c[kPlanner], 1))});
  }
  return markdown_table({"hand", "the paper, or target", "here", ""}, rows);
}

std::string quality_table(const std::array<Figure12Curve, 4>& curves) {
  Row headings{"n"};
  std::vector<Row> rows;
  headings.insert(headings.end(), kTitles.begin(), kTitles.end());
  for (const int rank : kShownRanks) {
    Row row{fmt::format("{}", rank)};
    for (const Figure12Curve& curve : curves) row.push_back(fmt::format("{:.4f}", at(curve, rank)));
    rows.push_back(row);
  }
  return markdown_table(headings, rows);
}

std::string time_table(const std::array<Figure12Curve, 4>& curves) {
  std::vector<Row> rows;
  for (std::size_t m = 0; m < curves.size(); ++m) {
    const Figure12Curve& c = curves[m];
    rows.push_back({kTitles[m], m == kPlanner ? "-" : fmt::format("{:.0f}", c.candidates),
                    fmt::format("{:.1f}", c.distinct), fmt::format("{}", c.without),
                    fmt::format("{:.2f} s", c.seconds)});
  }
  return markdown_table({"", "pre-grasps", "distinct grasps", "models without any", "time of a core"}, rows);
}

std::string hand_part(const Figure12& result, std::size_t hand) {
  const std::string& name = result.hands[hand];
  return fmt::format(
             "\n## {0}\n\n![Quality of the n-th best "
             "grasp](figure12/{0}.png)\n\n([SVG](figure12/{0}.svg))\n\n",
             name) +
         quality_table(result.curves[hand]) + "\nMeans over the models:\n\n" +
         time_table(result.curves[hand]);
}

LineChart chart_of(const Figure12& result, std::size_t hand) {
  LineChart chart;
  chart.title = fmt::format("n-th best grasp, mean of {} models: {}", result.models, result.hands[hand]);
  chart.x_name = "n";
  chart.y_name = "epsilon";
  chart.x_min = 1.0;
  chart.x_max = static_cast<double>(kChartRanks);
  double most = 0.0;
  for (std::size_t m = 0; m < kTitles.size(); ++m) {
    const Figure12Curve& curve = result.curves[hand][m];
    LineChart::Curve drawn;
    drawn.name = kTitles[m];
    drawn.dashed = m == kPlanner;
    for (std::size_t n = 0; n < kChartRanks; ++n)
      drawn.points.emplace_back(static_cast<double>(n + 1), curve.epsilon[n]);
    most = std::max(most, curve.epsilon.front());
    chart.curves.push_back(std::move(drawn));
  }
  chart.y_max = std::max(0.05, std::ceil(most / 0.05) * 0.05);
  return chart;
}

}  // namespace

std::string figure12_markdown(const Figure12& result, const ExperimentRecord& record) {
  std::string page = "# Fig. 12: grasps by like objects beside the planner\n\n";
  page += fmt::format("Made by `{}`\nwith eigengrasp {} on {}, in {:.0f} min", record.command, record.version,
                      describe(record.machine), result.wall_seconds / 60.0);
  if (result.resumed > 0) page += fmt::format(" ({} models were done before)", result.resumed);
  page += ".\n\n" + statements(result);
  page += fmt::format(
      "\nEach of {} models is left out of the store at scale 1 and grasped by the stored pre-grasps of {} "
      "neighbours, {} at each of up to two scales ([how](../theory/transfer.md)), aligned by PCA. The "
      "planner's "
      "grasps are those that the store holds of the model itself: the enhanced search with the store's "
      "budget. "
      "Epsilon (l1, eight edges) of the n-th best distinct grasp, mean over all models; a model with fewer "
      "than n "
      "grasps counts 0. Neighbours within a class and random ones by seed {}; models without a class take "
      "random "
      "ones for it. Times are of a core: neighbours, alignments, fitting, closing and rating; the object's "
      "preparation, {:.2f} s a model, comes to it. Of the planner: its unit of work.\n",
      result.models, result.neighbors,
      result.candidates > 0 ? fmt::format("the best {}", result.candidates) : std::string("all"), result.seed,
      result.prepare_seconds);
  for (std::size_t h = 0; h < result.hands.size(); ++h) page += hand_part(result, h);
  if (!result.left_out.empty()) {
    page += fmt::format("\n## Left out\n\n{} models", result.left_out.size());
    page += fmt::format("; the first is {}: {}.\n", result.left_out.begin()->first,
                        result.left_out.begin()->second);
  }
  return page;
}

std::string figure12_json(const Figure12& result, const ExperimentRecord& record) {
  OrderedJson json{{"format", "eigengrasp-figure12"}, {"version", 1}};
  json.update(record_json(record));
  json["models"] = result.models;
  json["neighbors"] = result.neighbors;
  json["candidates"] = result.candidates;
  json["seed"] = result.seed;
  json["wall_seconds"] = result.wall_seconds;
  json["resumed"] = result.resumed;
  json["prepare_seconds"] = result.prepare_seconds;
  json["left_out"] = result.left_out;
  json["hands"] = OrderedJson::array();
  for (std::size_t h = 0; h < result.hands.size(); ++h) {
    OrderedJson curves = OrderedJson::array();
    for (std::size_t m = 0; m < kFigure12Methods.size(); ++m) {
      const Figure12Curve& c = result.curves[h][m];
      curves.push_back({{"method", kFigure12Methods[m]},
                        {"epsilon", c.epsilon},
                        {"distinct", c.distinct},
                        {"pregrasps", c.candidates},
                        {"models_without", c.without},
                        {"seconds", c.seconds}});
    }
    json["hands"].push_back({{"hand", result.hands[h]}, {"curves", curves}});
  }
  return pretty_text(json);
}

std::string figure12_svg(const Figure12& result, std::size_t hand) {
  return chart_svg(chart_of(result, hand));
}

Image figure12_picture(const Figure12& result, std::size_t hand) {
  return draw_chart(chart_of(result, hand));
}

}  // namespace eigengrasp
