// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/format.h>

#include <algorithm>

#include "eigengrasp/experiments/performance.hpp"
#include "eigengrasp/experiments/reference_figures.hpp"
#include "experiments/markdown.hpp"

namespace eigengrasp {

namespace {

using Row = std::vector<std::string>;

std::string thousands(double number) {
  return number >= 99500.0 ? fmt::format("{:.2f} M", 1e-6 * number) : fmt::format("{:.0f}", number);
}

std::string ratio_text(double graspit, double ours) {
  return ours > 0.0 ? fmt::format("{:.0f} x", graspit / ours) : "-";
}

const char* verdict(bool met) {
  return met ? "met" : "**not met**";
}

const ThreadedPerformance& on_one(const ScenePerformance& scene) {
  return scene.by_threads.front();
}

double candidate_seconds(const ScenePerformance& scene) {
  return scene.steps.close + scene.steps.contacts + scene.steps.epsilon;
}

Row scene_row(const ScenePerformance& s, const ThreadedPerformance& by) {
  return {s.hand,
          s.object,
          fmt::format("{}", by.threads),
          thousands(by.states_per_second),
          fmt::format("{:.0f} %", 100.0 * s.legal_share),
          thousands(by.candidates_per_second),
          fmt::format("{:.0f}", 1e6 * s.steps.close),
          fmt::format("{:.0f}", 1e6 * s.steps.contacts),
          fmt::format("{:.1f}", 1e6 * s.steps.closure),
          fmt::format("{:.1f}", 1e6 * s.steps.epsilon),
          fmt::format("{:.0f}", 1e3 * by.run),
          fmt::format("{:.0f}", 1e3 * by.paper_run),
          fmt::format("{:.0f}", 1e3 * by.prepare),
          fmt::format("{:.0f}", 1e3 * by.prepare_object),
          fmt::format("{:.0f}", 1e3 * by.prepare_cached),
          fmt::format("{:.0f}", 1e-6 * static_cast<double>(s.peak_memory))};
}

std::string scenes_table(const PerformanceReport& report) {
  std::vector<Row> rows;
  for (const ScenePerformance& scene : report.scenes)
    for (const ThreadedPerformance& by : scene.by_threads) rows.push_back(scene_row(scene, by));
  return markdown_table({"hand", "object", "threads", "states/s", "legal", "candidates/s", "close [us]",
                         "contacts [us]", "closure [us]", "epsilon [us]", "run [ms]", "paper's run [ms]",
                         "prepare [ms]", "the object [ms]", "from cache [ms]", "memory [MB]"},
                        rows);
}

/// States of all hands that GraspIt! has figures of.
void add_state_rows(const PerformanceReport& report, std::vector<Row>& rows) {
  for (const ScenePerformance& s : report.scenes) {
    if (!s.paper_hand) continue;
    const double graspit = graspit_state_seconds(*s.paper_hand);
    const bool human = s.paper_hand == PaperHand::human;
    const auto add = [&](const char* what, double rate) {
      if (rate <= 0.0) return;
      rows.push_back({fmt::format("{} on {}: one state, {}", s.hand, s.object, what),
                      fmt::format("{:.2f} ms", 1e3 * graspit), human ? "0.5 us" : "400 x",
                      fmt::format("{:.2f} us", 1e6 / rate), ratio_text(graspit, 1.0 / rate),
                      verdict(1.0 / rate <= graspit / 400.0 && (!human || 1.0 / rate <= 0.5e-6))});
    };
    add("legality and energy", s.judged_per_second);
    add("legality where the energy can be taken", on_one(s).states_per_second);
  }
}

void add_run_rows(const PerformanceReport& report, std::vector<Row>& rows) {
  for (const ScenePerformance& s : report.scenes) {
    if (s.candidates == 0) continue;
    const double candidate = candidate_seconds(s);
    rows.push_back({fmt::format("{} on {}: one candidate, close, contacts, epsilon", s.hand, s.object),
                    "50 ms", "0.25 ms", fmt::format("{:.2f} ms", 1e3 * candidate),
                    ratio_text(kGraspitCandidateSeconds, candidate), verdict(candidate <= 0.25e-3)});
  }
  for (const ScenePerformance& s : report.scenes) {
    const auto add = [&](const std::string& how, double run) {
      rows.push_back(
          {fmt::format("{} on {}: {} states, {}", s.hand, s.object, report.options.iterations, how),
           "20-50 s", "0.1 s", fmt::format("{:.3f} s", run), ratio_text(kGraspitRunSeconds, run),
           verdict(run <= 0.1)});
    };
    add("best 20 closed and rated (the paper's search)", on_one(s).paper_run);
    if (report.options.search != SearchKind::paper)
      add(fmt::format("{} closed on the way, best 20 kept", s.closed_on_the_way), on_one(s).run);
  }
}

void add_other_rows(const PerformanceReport& report, std::vector<Row>& rows) {
  const WrenchPerformance& w = report.wrench;
  rows.push_back({"epsilon of 8 contacts x 8 edges", "17 ms", "0.5 ms",
                  fmt::format("{:.3f} ms", 1e3 * w.epsilon), ratio_text(kQhullEpsilonSeconds, w.epsilon),
                  verdict(w.epsilon <= 0.5e-3)});
  rows.push_back({"closure yes or no of 8 contacts x 8 edges", "17 ms", "0.03 ms",
                  fmt::format("{:.4f} ms", 1e3 * w.closure), ratio_text(kQhullEpsilonSeconds, w.closure),
                  verdict(w.closure <= 0.03e-3)});
  for (const ScenePerformance& s : report.scenes) {
    const bool again = std::any_of(report.scenes.data(), &s,
                                   [&](const ScenePerformance& other) { return other.object == s.object; });
    if (again) continue;
    const double prepare = s.by_threads.front().prepare_object;
    rows.push_back({fmt::format("preparation of {}, {} triangles", s.object, s.triangles), "-", "0.5 s",
                    fmt::format("{:.2f} s", prepare), "-", verdict(prepare <= 0.5)});
  }
  for (const ScenePerformance& s : report.scenes)
    if (s.by_threads.size() == 2 && s.by_threads[1].threads == 2) {
      const double gain = s.by_threads[1].states_per_second / s.by_threads[0].states_per_second;
      rows.push_back({fmt::format("{} on {}: states/s of two threads over one", s.hand, s.object), "-",
                      "1.9 x", fmt::format("{:.2f} x", gain), "-", verdict(gain >= 1.9)});
    }
  std::int64_t memory = 0;
  for (const ScenePerformance& s : report.scenes) memory = std::max(memory, s.peak_memory);
  rows.push_back({"memory of a run (largest of the above)", "-", "200 MB",
                  fmt::format("{:.0f} MB", 1e-6 * static_cast<double>(memory)), "-",
                  verdict(memory <= 200'000'000)});
}

}  // namespace

std::string performance_text(const ScenePerformance& s) {
  std::string text = fmt::format(
      "{} on {}: {:.0f} % of the states legal, {} judged in full a second, {} candidates with {:.1f} "
      "contacts\n",
      s.hand, s.object, 100.0 * s.legal_share, thousands(s.judged_per_second), s.candidates, s.contacts);
  for (const ThreadedPerformance& by : s.by_threads)
    text += fmt::format(
        "  {} thread{}: {} states/s, {} candidates/s; a run {:.3f} s, preparation {:.3f} s (the object "
        "{:.3f} s), {:.3f} s from the cache\n",
        by.threads, by.threads == 1 ? "" : "s", thousands(by.states_per_second),
        thousands(by.candidates_per_second), by.run, by.prepare, by.prepare_object, by.prepare_cached);
  return text +
         fmt::format(
             "  a candidate: close {:.0f} us, contacts {:.0f} us, closure {:.1f} us, epsilon {:.1f} us; "
             "peak memory {:.0f} MB\n",
             1e6 * s.steps.close, 1e6 * s.steps.contacts, 1e6 * s.steps.closure, 1e6 * s.steps.epsilon,
             1e-6 * static_cast<double>(s.peak_memory));
}

std::string performance_markdown(const PerformanceReport& report) {
  std::vector<Row> rows;
  add_state_rows(report, rows);
  add_run_rows(report, rows);
  add_other_rows(report, rows);
  return fmt::format(
             "# Performance\n\nMade by `{}` (do not edit). eigengrasp {}; {}. Search: {}, {} states a "
             "run.\n\n## Targets\n\n\"GraspIt!\" is GraspIt! itself, its qt5 branch with its own models, "
             "one core of a two-core Xeon virtual machine with AVX-512; of a range (states 0.15-0.56 ms, "
             "candidates 30-110 ms, runs 15-58 s) the ratio takes the figure named, or the lower end. Ours "
             "is on one thread where nothing else is said.\n\n{}\n",
             report.record.command, report.record.version, describe(report.record.machine),
             report.options.search == SearchKind::paper ? "the paper's" : "staged", report.options.iterations,
             markdown_table({"what", "GraspIt!", "target", "ours", "GraspIt! / ours", ""}, rows)) +
         "## All figures\n\nStates/s: states that the planner's search drew, tested and rated over its "
         "time; medians over the seeds. Candidates: the pre-grasps of seed 1; steps are means over them, "
         "medians over repetitions, on one thread; candidates/s: closing, contacts and epsilon. A run: "
         "search, closing, rating and exact check; the paper's closes the 20 of lowest energy, once. "
         "Prepare: hand and object, all anew; a hand is prepared "
         "once and then comes from the cache. Memory: peak of the process.\n\n" +
         scenes_table(report);
}

}  // namespace eigengrasp
