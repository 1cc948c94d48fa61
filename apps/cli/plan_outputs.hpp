// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "eigengrasp/report/grasp_file.hpp"

namespace eigengrasp::cli {

/// What a command that finds grasps prints and writes, as the user says it.
struct PlanOutputs {
  std::filesystem::path folder;  ///< empty: one in out/
  int rows = 20;                 ///< of the table; 0: all
  bool pictures = true;

  /// Picks out/NAME where no folder was given. @throws Error where it cannot be written to
  void require_folder(const std::string& name);
};

/// --out, --rows, --no-pictures. @param folder what the help calls the one in out/
void add_output_options(CLI::App& command, PlanOutputs& outputs, const std::string& folder);

/// Hand, object, table and explanation.
void print_grasps(const Scene& scene, const PlanResult& result, const PlanOutputs& outputs);

/// grasps.json, grasps.csv; where there are grasps and pictures are wanted grasps.png, and grasps.glb of the
/// first.
void write_plan_files(const Scene& scene, const GraspFile& file, const PlanOutputs& outputs);

}  // namespace eigengrasp::cli
