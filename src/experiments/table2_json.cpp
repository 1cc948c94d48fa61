// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/reference_figures.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "eigengrasp/experiments/table2_report.hpp"
#include "experiments/record_json.hpp"

namespace eigengrasp {

namespace {

OrderedJson run_json(const Table2Run& run) {
  const CandidateCounts& c = run.candidates;
  const PlanTimings& t = run.timings;
  return {
      {"seed", run.seed},
      {"form_closed", c.form_closed},
      {"tested", c.tested},
      {"not_closed", c.not_closed},
      {"no_contact", c.no_contact},
      {"penetrating", c.penetrating},
      {"best_epsilon", run.best && run.best->form_closure ? run.best->epsilon : 0.0},
      {"seconds", {{"prepare", t.prepare}, {"search", t.anneal}, {"close", t.close}, {"total", t.total}}}};
}

OrderedJson cell_json(const Table2Cell& cell) {
  OrderedJson json{{"hand", name_of(cell.hand)},
                   {"object", name_of(cell.object)},
                   {"form_closed_mean", mean(cell.form_closed())},
                   {"form_closed_standard_deviation", standard_deviation(cell.form_closed())},
                   {"tested_mean", mean(cell.tested())},
                   {"paper", paper_form_closed(cell.hand, cell.object)},
                   {"graspit", graspit_form_closed(cell.hand, cell.object)},
                   {"runs", OrderedJson::array()}};
  for (const Table2Run& run : cell.runs) json["runs"].push_back(run_json(run));
  return json;
}

OrderedJson part_json(const Table2Part& part) {
  OrderedJson json{{"search", part.search == SearchKind::paper ? "paper" : "staged"},
                   {"friction", part.friction == FrictionCase::one ? "one" : "materials"},
                   {"form_closed_mean", part.mean_form_closed()},
                   {"cells", OrderedJson::array()}};
  for (const Table2Cell& cell : part.cells) json["cells"].push_back(cell_json(cell));
  return json;
}

}  // namespace

std::string table2_json(const Table2& table, const ExperimentRecord& record) {
  const Table2Options& o = table.options;
  OrderedJson json{{"format", "eigengrasp-table2"}, {"version", 1}};
  json.update(record_json(record));
  json["models"] = o.models.shipped() ? "shipped" : "graspit";
  json["options"] = {
      {"seeds", o.seeds}, {"iterations", o.iterations}, {"grasps", o.grasps}, {"threads", o.threads}};
  json["targets"] = OrderedJson::array();
  for (const Table2Target& target : check_targets(table))
    json["targets"].push_back({{"target", target.text}, {"measured", target.measured}, {"met", target.met}});
  json["parts"] = OrderedJson::array();
  for (const Table2Part& part : table.parts) json["parts"].push_back(part_json(part));
  return pretty_text(json);
}

}  // namespace eigengrasp
