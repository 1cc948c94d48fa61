// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/table2.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/experiments/reference_figures.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "experiments/table2_text.hpp"

namespace eigengrasp {

namespace {

PlanOptions plan_options(const Table2Options& options, SearchKind search, int seed) {
  PlanOptions plan;
  plan.iterations = options.iterations;
  plan.grasps = options.grasps;
  plan.threads = options.threads;
  plan.seed = static_cast<std::uint64_t>(seed);
  plan.search = search;
  plan.cache = options.cache;
  plan.stop = options.stop;
  return plan;
}

/// Runs the cells and tells how far it is.
class Table2Runner {
 public:
  Table2Runner(const Table2Options& options, const PaperScenes& scenes) : options_(options), scenes_(scenes) {
    total_ = 4 * options.hands.size() * options.objects.size() * static_cast<std::size_t>(options.seeds);
  }

  Table2Part part(SearchKind search, FrictionCase friction) {
    Table2Part part{search, friction, {}};
    for (const PaperHand hand : options_.hands)
      for (const PaperObject object : options_.objects) {
        part.cells.push_back(cell(part, hand, object));
        if (stopped()) return part;
      }
    return part;
  }

  bool stopped() const { return options_.stop && options_.stop->stop_requested(); }

 private:
  Table2Cell cell(const Table2Part& part, PaperHand hand, PaperObject object) {
    Table2Cell cell{hand, object, {}};
    const Scene scene = scenes_.scene(hand, object, part.friction);
    for (int seed = 1; seed <= options_.seeds && !stopped(); ++seed) {
      if (options_.progress)
        options_.progress(
            static_cast<double>(done_) / static_cast<double>(total_),
            fmt::format("{}: {} on {}, seed {}", title_of(part), title_of(hand), name_of(object), seed));
      PlanResult result = plan_grasps(scene, plan_options(options_, part.search, seed));
      Table2Run run{static_cast<std::uint64_t>(seed), result.candidates, result.timings, {}, {}};
      if (!result.grasps.empty()) run.best = std::move(result.grasps.front());
      run.milestones = std::move(result.milestones);
      cell.runs.push_back(std::move(run));
      ++done_;
    }
    return cell;
  }

  const Table2Options& options_;
  const PaperScenes& scenes_;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
};

template <typename Number>
std::vector<double> of_runs(const std::vector<Table2Run>& runs, Number number) {
  std::vector<double> numbers;
  for (const Table2Run& run : runs) numbers.push_back(number(run));
  return numbers;
}

bool is_whole(const Table2& table) {
  const Table2Options& o = table.options;
  const std::size_t cells = kPaperHands.size() * kPaperObjects.size();
  return !table.stopped_early && o.iterations == 70000 && o.grasps == 20 && table.parts.size() == 4 &&
         std::all_of(table.parts.begin(), table.parts.end(),
                     [&](const Table2Part& part) { return part.cells.size() == cells; });
}

Table2Target mean_target(const Table2Part& part, double goal) {
  const double measured = part.mean_form_closed();
  return {fmt::format("{}: mean at least {:g}", title_of(part), goal), fmt::format("{:.1f}", measured),
          measured >= goal};
}

Table2Target no_cell_below(const Table2Part& part, double (*reference)(PaperHand, PaperObject),
                           const char* whose) {
  std::string below;
  for (const Table2Cell& cell : part.cells)
    if (mean(cell.form_closed()) < reference(cell.hand, cell.object))
      below += fmt::format("{}{} on {} {:.1f} < {:.1f}", below.empty() ? "" : "; ", title_of(cell.hand),
                           name_of(cell.object), mean(cell.form_closed()), reference(cell.hand, cell.object));
  return {fmt::format("{}: no cell below {}", title_of(part), whose), below.empty() ? "none" : below,
          below.empty()};
}

}  // namespace

std::vector<std::string> Table2Options::validate() const {
  std::vector<std::string> violations;
  const auto require = [&](bool sound, std::string sentence) {
    if (!sound) violations.push_back(std::move(sentence));
  };
  require(seeds >= 1 && seeds <= 1000, fmt::format("seeds is {}, expected 1 to 1000", seeds));
  require(iterations >= 1, fmt::format("iterations is {}, expected 1 or more", iterations));
  require(grasps >= 1 && grasps <= 100000, fmt::format("grasps is {}, expected 1 to 100000", grasps));
  require(threads >= 0 && threads <= 4096, fmt::format("threads is {}, expected 0 (all) to 4096", threads));
  require(!hands.empty(), "no hand is given, expected at least one");
  require(!objects.empty(), "no object is given, expected at least one");
  return violations;
}

std::vector<double> Table2Cell::form_closed() const {
  return of_runs(runs, [](const Table2Run& run) { return run.candidates.form_closed; });
}

std::vector<double> Table2Cell::tested() const {
  return of_runs(runs, [](const Table2Run& run) { return run.candidates.tested; });
}

double Table2Part::mean_form_closed() const {
  std::vector<double> means;
  for (const Table2Cell& cell : cells) means.push_back(mean(cell.form_closed()));
  return mean(means);
}

const Table2Cell& Table2Part::cell(PaperHand hand, PaperObject object) const {
  return *std::find_if(cells.begin(), cells.end(),
                       [&](const Table2Cell& c) { return c.hand == hand && c.object == object; });
}

const Table2Part& Table2::part(SearchKind search, FrictionCase friction) const {
  return *std::find_if(parts.begin(), parts.end(),
                       [&](const Table2Part& p) { return p.search == search && p.friction == friction; });
}

Table2 run_table2(const Table2Options& options) {
  if (const auto violations = options.validate(); !violations.empty()) throw Error(violations.front());
  Table2 table{options, PaperScenes(options.models, options.hands, options.objects, options.log), {}, false};
  Table2Runner runner(table.options, table.scenes);
  for (const SearchKind search : {SearchKind::paper, SearchKind::staged})
    for (const FrictionCase friction : {FrictionCase::materials, FrictionCase::one})
      if (!runner.stopped()) table.parts.push_back(runner.part(search, friction));
  table.stopped_early = runner.stopped();
  return table;
}

std::vector<Table2Target> check_targets(const Table2& table) {
  if (!is_whole(table)) return {};
  const Table2Part& paper = table.part(SearchKind::paper, FrictionCase::one);
  const Table2Part& ours = table.part(SearchKind::staged, FrictionCase::one);
  const Table2Part& materials = table.part(SearchKind::staged, FrictionCase::materials);
  return {mean_target(paper, 8.0), mean_target(ours, 14.0),
          no_cell_below(ours, paper_form_closed, "the paper's"), mean_target(materials, 11.0),
          no_cell_below(materials, graspit_form_closed, "GraspIt!'s own")};
}

}  // namespace eigengrasp
