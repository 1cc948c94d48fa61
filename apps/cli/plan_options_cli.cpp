// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/plan_options_cli.hpp"

#include <charconv>
#include <cmath>

#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"

namespace eigengrasp::cli {

void add_wrench_options(CLI::App& command, PlannerChoice& choice) {
  command.add_option("--norm", choice.norm,
                     "Wrench space: l1 (all normal forces together 1) or linf (each 1)");
  command.add_option("--edges", choice.options.cone_edges, "Edges of each friction cone");
  command.add_flag("--true-cone", choice.true_cone, "The friction cones themselves instead of their edges");
  command.add_option("--torque-scale", choice.options.torque_scale,
                     "Length that torques are divided by [m]; 0: the object's largest radius");
  command.add_option("--epsilon-min", choice.options.epsilon_min, "Form closure means epsilon at least this");
}

void add_planner_options(CLI::App& command, PlannerChoice& choice) {
  PlanOptions& o = choice.options;
  command.add_option("--iterations", o.iterations, "States to draw and evaluate, all chains together");
  command.add_option("--time", choice.time,
                     "Time limit of the search, such as 2s or 500ms; alone: without --iterations' limit");
  command.add_option("--grasps", o.grasps, "Distinct pre-grasps to keep, close and rate");
  command.add_option("--seed", o.seed, "The same seed gives the same grasps on any number of threads")
      ->check([](const std::string& text) {
        return text.starts_with('-') ? "is " + text + ", expected 0 or more" : std::string();
      });
  command.add_option("--energy", choice.energy,
                     "What the search minimises: contact (eqs. 6, 7) or wrench (eq. 8)");
  command.add_option(
      "--search", choice.search,
      "staged: many short chains, candidates closed on the way; tempering: the same with chains that trade "
      "temperatures instead of cooling; paper: one plain annealing chain; enhanced: pre-grasps refined by "
      "local searches until --grasps are form-closed");
  command.add_option("--eigengrasps", choice.amplitudes,
                     "Amplitudes to search over: a number, or 'all' degrees of freedom");
  command.add_option("--alpha", o.alpha,
                     "Length that weighs as much as a normal 90 degrees off, eq. (6) [m]");
  command.add_option(
      "--chains", o.chains,
      "Annealing chains of the staged and the tempering search, side by side; rounded up to whole sixteens");
  command.add_option("--threads", o.threads, "0: all; does not change the result");
  add_wrench_options(command, choice);
}

double parse_seconds(const std::string& option, const std::string& text) {
  double value = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  const std::string unit(end, last);
  const double factor = unit.empty() || unit == "s" ? 1.0 : unit == "ms" ? 1e-3 : unit == "min" ? 60.0 : 0.0;
  if (error != std::errc() || factor == 0.0 || !std::isfinite(value) || value <= 0.0)
    fail("{} is '{}', expected a positive time such as 2s, 500ms or 1min", option, text);
  return factor * value;
}

namespace {

int amplitude_count(const std::string& text, const HandModel& hand) {
  if (text.empty()) return std::min(2, hand.n_dof());
  if (text == "all") return hand.n_dof();
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0)
    fail("--eigengrasps is '{}', expected a number from 0 to {} or 'all'", text, hand.n_dof());
  return value;
}

}  // namespace

PlanOptions understand(const PlannerChoice& choice, const HandModel& hand) {
  PlanOptions o = choice.options;
  if (choice.energy == "wrench") {
    o.energy = EnergyKind::wrench;
  } else if (choice.energy != "contact") {
    fail("--energy is '{}', expected contact or wrench", choice.energy);
  }
  if (choice.search == "paper") {
    o.search = SearchKind::paper;
  } else if (choice.search == "tempering") {
    o.search = SearchKind::tempering;
  } else if (choice.search == "enhanced") {
    o.search = SearchKind::enhanced;
  } else if (choice.search != "staged") {
    fail("--search is '{}', expected staged, tempering, enhanced or paper", choice.search);
  }
  if (choice.norm == "linf") {
    o.norm = WrenchNorm::linf;
  } else if (choice.norm != "l1") {
    fail("--norm is '{}', expected l1 or linf", choice.norm);
  }
  if (choice.true_cone) o.cone = ConeModel::exact;
  if (!choice.time.empty()) {
    o.time_limit = parse_seconds("--time", choice.time);
    if (!choice.iterations_given) o.iterations = 0;
  }
  o.amplitudes = amplitude_count(choice.amplitudes, hand);
  o.cache = user_cache();
  return o;
}

void require_sound(const PlanOptions& options, const HandModel& hand) {
  const auto violations = options.validate(hand);
  if (!violations.empty()) fail("{}", violations.front());
}

}  // namespace eigengrasp::cli
