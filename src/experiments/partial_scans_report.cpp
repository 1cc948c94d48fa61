// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eigengrasp/experiments/partial_scans.hpp"
#include "eigengrasp/experiments/statistics.hpp"

namespace eigengrasp {

namespace {

using Json = nlohmann::ordered_json;

const char* name_of(ScanPlanner planner) {
  return planner == ScanPlanner::transfer ? "transfer" : "planner";
}

/// All trials of one way with one hand, together.
struct Totals {
  int views = 0, with_grasps = 0, found = 0, tried = 0, closed = 0, hundred = 0;
  std::vector<double> seconds;
};

Totals add_up(const PartialScans& result, bool simulated, const std::string& hand, ScanPlanner planner) {
  Totals totals;
  for (const ScanTrial& trial : result.trials) {
    if (trial.simulated != simulated) continue;
    for (const ScanGrasps& g : trial.grasps) {
      if (g.hand != hand || g.planner != planner) continue;
      ++totals.views;
      totals.with_grasps += g.found > 0;
      totals.hundred += g.found >= 100;
      totals.found += g.found;
      totals.tried += g.tried;
      totals.closed += g.closed;
      totals.seconds.push_back(g.seconds);
    }
  }
  return totals;
}

std::string share(int part, int whole) {
  return whole > 0 ? fmt::format("{:.0f} %", 100.0 * part / whole) : "-";
}

std::string totals_table(const PartialScans& result, const PartialScansOptions& options, bool simulated) {
  std::string text =
      "| hand | grasps by | views | with grasps | grasps a view | views with 100 | tried on the complete "
      "object | "
      "still form-closed | median core time |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& hand : options.hands) {
    for (const ScanPlanner planner : kScanPlanners) {
      const Totals t = add_up(result, simulated, hand->name, planner);
      if (t.views == 0) continue;
      text += fmt::format("| {} | {} | {} | {} | {:.1f} | {} | {} | {} | {:.2f} s |\n", hand->name,
                          name_of(planner), t.views, t.with_grasps, t.found / static_cast<double>(t.views),
                          planner == ScanPlanner::transfer ? fmt::format("{}", t.hundred) : "-", t.tried,
                          share(t.closed, t.tried), median(t.seconds));
    }
  }
  return text;
}

std::string cell_of(const ScanTrial& trial, const std::string& hand, ScanPlanner planner) {
  for (const ScanGrasps& g : trial.grasps)
    if (g.hand == hand && g.planner == planner)
      return g.tried > 0 ? fmt::format("{}: {} of {}", g.found, g.closed, g.tried)
                         : fmt::format("{}", g.found);
  return "-";
}

/// Agreement with the complete object where that is in the same frame, else how far the scan lies from it.
std::string likeness(const ScanTrial& trial) {
  if (trial.agreement >= 0.0) return fmt::format("{:.2f}", trial.agreement);
  if (trial.misfit == 0.0) return "-";
  return fmt::format("{:.1f} mm{}", 1e3 * trial.misfit, trial.complete.empty() ? ", not tried" : "");
}

std::string trials_table(const PartialScans& result, const PartialScansOptions& options, bool simulated) {
  std::string text = fmt::format("| object | view | seen | mirrored | {} |",
                                 simulated ? "agreement" : "misfit, or agreement");
  std::string line = "|---|---|---|---|---|";
  for (const auto& hand : options.hands)
    for (const ScanPlanner planner : kScanPlanners) {
      text += fmt::format(" {}, {} |", hand->name, name_of(planner));
      line += "---|";
    }
  text += "\n" + line + "\n";
  for (const ScanTrial& trial : result.trials) {
    if (trial.simulated != simulated) continue;
    text += fmt::format("| {} | {} | ", trial.object, trial.view);
    if (!trial.failure.empty()) {
      text += fmt::format("{} |\n", trial.failure);
      continue;
    }
    text += fmt::format("{:.0f} % | {} | {} |", 100.0 * trial.seen_share, trial.mirrored ? "yes" : "no",
                        likeness(trial));
    for (const auto& hand : options.hands)
      for (const ScanPlanner planner : kScanPlanners)
        text += fmt::format(" {} |", cell_of(trial, hand->name, planner));
    text += "\n";
  }
  return text;
}

std::string pictures_of(const PartialScans& result, bool simulated) {
  std::string text;
  for (const ResultPicture& picture : result.pictures) {
    const bool of_simulated =
        std::any_of(result.trials.begin(), result.trials.end(), [&](const ScanTrial& t) {
          return t.simulated && picture.file.find("/" + t.object + "-" + t.view + "-") != std::string::npos;
        });
    if (of_simulated == simulated) text += fmt::format("![{}]({})\n\n", picture.caption, picture.file);
  }
  return text;
}

}  // namespace

std::string partial_scans_markdown(const PartialScans& result, const PartialScansOptions& options,
                                   const ExperimentRecord& record) {
  const StoreCounts store = options.store->counts();
  std::string text = fmt::format(
      "# Grasps from one view\n\nMade by `{}`, version {}, on {}.\n\n"
      "A depth camera sees one side of an object. The space behind it is taken to hold the mirror image of "
      "what is "
      "seen\n(how: docs/theory/scans.md); grasps are then found on that surface, by transfer from the store "
      "({} "
      "neighbours, all their\npre-grasps) and by the planner (70,000 states, {} grasps). The store holds {} "
      "objects "
      "and {} grasps; {} of its units wait.\n\n",
      record.command, record.version, describe(record.machine), options.neighbors, options.best, store.models,
      store.grasps, store.waiting);
  const auto has = [&](bool simulated) {
    return std::any_of(result.trials.begin(), result.trials.end(),
                       [&](const ScanTrial& t) { return t.simulated == simulated; });
  };
  if (has(true)) {
    text += fmt::format(
        "## Simulated cameras\n\n{} views of each complete object, 40 degrees from above, at {:.2f} m, noise "
        "{:.1f} "
        "mm at 1 m. The {} best grasps of each\nsurface are tried on the complete object: the hand comes "
        "along "
        "its approach direction until it touches, and closes.\n\n",
        options.views, options.distance, 1e3 * options.noise, options.best);
    text +=
        totals_table(result, options, true) +
        "\nGrasps found: of the best, how many are form-closed on the "
        "complete object. Agreement: volume common to surface and\ncomplete object over that of both.\n\n" +
        trials_table(result, options, true) + "\n" + pictures_of(result, true);
  }
  if (has(false))
    text +=
        fmt::format(
            "## Real scans\n\nSegmented clouds of a depth camera; where it stood is estimated. The paper "
            "found 88 (human hand) and 112 (Barrett hand)\ngrasps of one object (Fig. 13). Where there is "
            "a complete model of the object, what was seen is laid upon it (one-sided\nICP; misfit: root "
            "mean square distance), and if it lies within {:.0f} mm, the {} best grasps are tried on it.\n"
            "Range scans that come with their poses are views of one frame, the complete object's, and "
            "\"all\" is all of them together: what no\nview shows then counts as the object.\n\n",
            1e3 * kMostMisfit, options.best) +
        totals_table(result, options, false) + "\n" + trials_table(result, options, false) + "\n" +
        pictures_of(result, false);
  return text;
}

std::string partial_scans_json(const PartialScans& result, const ExperimentRecord& record) {
  Json trials = Json::array();
  for (const ScanTrial& t : result.trials) {
    Json grasps = Json::array();
    for (const ScanGrasps& g : t.grasps)
      grasps.push_back({{"hand", g.hand},
                        {"by", name_of(g.planner)},
                        {"found", g.found},
                        {"best_epsilon", g.best_epsilon},
                        {"seconds", g.seconds},
                        {"tried", g.tried},
                        {"closed", g.closed}});
    Json trial = {{"object", t.object},
                  {"view", t.view},
                  {"simulated", t.simulated},
                  {"mirrored", t.mirrored},
                  {"seen_share", t.seen_share},
                  {"seconds", t.seconds},
                  {"grasps", grasps}};
    if (!t.complete.empty()) trial["complete"] = t.complete;
    if (t.misfit > 0.0) trial["misfit"] = t.misfit;
    if (t.agreement >= 0.0) trial["agreement"] = t.agreement;
    if (!t.failure.empty()) trial["failure"] = t.failure;
    trials.push_back(std::move(trial));
  }
  const Json json = {{"command", record.command},
                     {"version", record.version},
                     {"machine", describe(record.machine)},
                     {"trials", trials}};
  return json.dump(2) + "\n";
}

}  // namespace eigengrasp
