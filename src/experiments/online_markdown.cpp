// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eigengrasp/experiments/online_trial.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "experiments/markdown.hpp"

namespace eigengrasp {

namespace {

using Row = std::vector<std::string>;

std::string milliseconds(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.1f} ms", 1e3 * seconds) : "none";
}

/// All scenes together.
struct Totals {
  std::vector<double> first_grasp, updates, postures, candidates;
  int approaches = 0;
  int form_closed = 0;
  std::vector<double> seconds;
};

Totals totals_of(const OnlineReport& report) {
  Totals t;
  for (const OnlineSceneTrial& s : report.scenes) {
    t.first_grasp.insert(t.first_grasp.end(), s.first_grasp.begin(), s.first_grasp.end());
    t.updates.insert(t.updates.end(), s.updates.begin(), s.updates.end());
    t.postures.push_back(s.postures_per_second);
    t.candidates.push_back(s.candidates_per_second);
    for (const OnlineApproach& a : s.approaches) {
      ++t.approaches;
      t.form_closed += a.form_closed;
      t.seconds.push_back(a.seconds);
    }
  }
  return t;
}

std::string met(bool met) {
  return met ? "met" : "**not met**";
}

double share(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : 0.0;
}

std::string targets_table(const OnlineReport& report, const Totals& t) {
  const double postures = median(t.postures);
  const double candidates = median(t.candidates);
  const double first = median(t.first_grasp);
  const double late = percentile(t.first_grasp, 0.99);
  const double closed = share(t.form_closed, t.approaches);
  std::vector<Row> rows{
      {"postures a second, first stage", "about 1,000", ">= 500,000", fmt::format("{:.0f}", postures),
       met(postures >= 5e5)},
      {"candidates a second, second stage", "about 20", ">= 2,000", fmt::format("{:.0f}", candidates),
       met(candidates >= 2e3)},
      {"new direction to first form-closed grasp, median", "< 2 s", "<= 30 ms", milliseconds(first),
       met(first <= 0.030)},
      {"the same, 99th percentile", "", "<= 250 ms", milliseconds(late), met(late <= 0.250)},
      {"approaches that end in a form-closed grasp", "all but a small minority", ">= 97 %",
       fmt::format("{:.1f} % of {}", 100.0 * closed, t.approaches), met(closed >= 0.97)},
  };
  if (!report.wire_latency.empty()) {
    const double wire = percentile(report.wire_latency, 0.99);
    rows.push_back({"wrist pose in to updated hand on the wire, 99th percentile", "-", "<= 20 ms",
                    milliseconds(wire), met(wire <= 0.020)});
  }
  return markdown_table({"what", "paper", "target", "here", ""}, rows);
}

std::string scenes_table(const OnlineReport& report) {
  std::vector<Row> rows;
  for (const OnlineSceneTrial& s : report.scenes) {
    const auto none =
        std::count_if(s.first_grasp.begin(), s.first_grasp.end(), [](double x) { return !std::isfinite(x); });
    int closed = 0;
    std::vector<double> seconds;
    for (const OnlineApproach& a : s.approaches) {
      closed += a.form_closed;
      seconds.push_back(a.seconds);
    }
    rows.push_back({s.hand, s.object, fmt::format("{:.0f} k", 1e-3 * s.postures_per_second),
                    fmt::format("{:.0f}", s.candidates_per_second),
                    fmt::format("{} of {}", s.form_closed, s.candidates), milliseconds(median(s.first_grasp)),
                    milliseconds(percentile(s.first_grasp, 0.9)), fmt::format("{}", none),
                    fmt::format("{} of {}", closed, s.approaches.size()),
                    fmt::format("{:.1f} s", median(seconds))});
  }
  return markdown_table({"hand", "object", "postures/s", "candidates/s", "form-closed", "first grasp, median",
                         "90th percentile", "directions without", "approaches that closed", "time of one"},
                        rows);
}

/// How long the first grasp takes, as bars of text.
std::string distribution(const std::vector<double>& first) {
  const std::vector<double> ends{0.005, 0.010, 0.020, 0.030, 0.050, 0.100, 0.250, 0.500, 2.0, INFINITY};
  std::vector<Row> rows;
  double low = 0.0;
  for (const double high : ends) {
    const auto n = std::count_if(first.begin(), first.end(), [&](double x) {
      return x >= low && (x < high || (std::isinf(high) && std::isinf(x)));
    });
    const double part = share(static_cast<int>(n), static_cast<int>(first.size()));
    std::string bar;
    for (int i = 0; i < static_cast<int>(std::lround(40.0 * part)); ++i) bar += "#";
    rows.push_back({std::isinf(high) ? "none within the limit"
                                     : fmt::format("{:.0f} - {:.0f} ms", 1e3 * low, 1e3 * high),
                    fmt::format("{}", n), fmt::format("{:.1f} %", 100.0 * part), "`" + bar + " `"});
    low = high;
  }
  return markdown_table({"time to the first grasp", "directions", "share", ""}, rows);
}

}  // namespace

std::string online_text(const OnlineSceneTrial& s) {
  int closed = 0;
  for (const OnlineApproach& a : s.approaches) closed += a.form_closed;
  return fmt::format(
      "{:16} {:10} {:6.0f} k postures/s {:6.0f} candidates/s  first grasp {:>9} (p90 {:>9})  {} of {} "
      "approaches closed\n",
      s.hand, s.object, 1e-3 * s.postures_per_second, s.candidates_per_second,
      milliseconds(median(s.first_grasp)), milliseconds(percentile(s.first_grasp, 0.9)), closed,
      s.approaches.size());
}

std::string online_targets(const OnlineReport& report) {
  return targets_table(report, totals_of(report));
}

std::string online_markdown(const OnlineReport& report) {
  const Totals t = totals_of(report);
  const OnlineTrialOptions& o = report.options;
  std::string page = "# The online planner with a simulated operator\n\n";
  page += fmt::format("Made by `{}`\nwith eigengrasp {} on {}.\n\n", report.record.command,
                      report.record.version, describe(report.record.machine));
  page += targets_table(report, t) + "\n";
  page += fmt::format(
      "One thread searches, one closes and rates; rates are medians over the scenes. New directions: the "
      "wrist "
      "appears at a random place around the object, the palm towards it ({:.0f} mm off at one sigma), any "
      "roll, "
      "{:.0f} mm from the object's ball; nothing that was found before counts; {} a scene, given up after "
      "{:.0f} s. "
      "Approaches: {} a scene; the operator's hand moves at {:.0f} mm/s with a tremor of {:.1f} mm, a "
      "tracker "
      "with {:.1f} mm and {:.1f} degrees of noise that loses, delays and repeats readings, and a reaction "
      "time "
      "of {:.0f} ms; in {:.0f} % of directions the operator changes its mind. An approach counts when the "
      "click "
      "made a form-closed grasp (epsilon, exact meshes) at the wrist where the hand then was. It takes "
      "{:.1f} s at the median. `update`, which makes the hand that is shown, takes {} at the median, {} at "
      "the "
      "99th percentile.\n\n",
      1e3 * o.traits.aim_error, 1e3 * o.traits.start_distance, o.directions, o.time_limit, o.approaches,
      1e3 * o.traits.speed, 1e3 * o.traits.tremor, 1e3 * o.traits.tracker_noise,
      o.traits.tracker_turn_noise * 57.29578, 1e3 * o.traits.reaction, 100.0 * o.traits.change_of_mind,
      median(t.seconds), milliseconds(median(t.updates)), milliseconds(percentile(t.updates, 0.99)));
  page += distribution(t.first_grasp) + "\n" + scenes_table(report);
  return page;
}

}  // namespace eigengrasp
