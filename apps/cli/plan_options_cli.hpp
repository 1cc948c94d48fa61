// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp::cli {

/// Options of the planner as text, before they are understood.
struct PlannerChoice {
  PlanOptions options;
  std::string energy = "contact";
  std::string search = "staged";
  std::string norm = "l1";
  std::string time;        ///< such as 2s, 500ms, 1.5
  std::string amplitudes;  ///< a number or "all"
  bool true_cone = false;
  bool iterations_given = false;
};

/// Options of the wrench space: --norm, --edges, --true-cone, --torque-scale, --epsilon-min.
void add_wrench_options(CLI::App& command, PlannerChoice& choice);
void add_planner_options(CLI::App& command, PlannerChoice& choice);

/// @throws Error for texts that mean nothing.
PlanOptions understand(const PlannerChoice& choice, const HandModel& hand);

/// @throws Error with the first option that is out of its bounds.
/// A positive time such as 2s, 500ms or 1min [s]. @throws Error that names the option
double parse_seconds(const std::string& option, const std::string& text);
void require_sound(const PlanOptions& options, const HandModel& hand);

}  // namespace eigengrasp::cli
