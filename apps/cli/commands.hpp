// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <CLI/App.hpp>

namespace eigengrasp::cli {

/// What the program returns to the shell.
enum ExitCode : int {
  success = 0,
  nothing_found = 1,  ///< sound input, but no form-closed grasp, a hand with errors, or a stopped experiment
  bad_input = 2,      ///< one sentence on stderr says what
};

// Each adds one command, whose callback sets exit_code where it does not end in success.
void add_plan_command(CLI::App& app, int& exit_code);
void add_transfer_command(CLI::App& app, int& exit_code);
void add_evaluate_command(CLI::App& app);
void add_quality_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_hand_command(CLI::App& app, int& exit_code);
void add_object_command(CLI::App& app);
void add_bench_command(CLI::App& app, int& exit_code);
void add_online_bench_command(CLI::App& app, int& exit_code);
void add_reproduce_command(CLI::App& app, int& exit_code);
void add_replay_command(CLI::App& app, int& exit_code);
/// Adds psb-retrieval to the command reproduce.
void add_reproduce_retrieval(CLI::App& reproduce, int& exit_code);
void add_scan_command(CLI::App& app);
void add_shape_command(CLI::App& app);
void add_serve_command(CLI::App& app);
void add_db_command(CLI::App& app, int& exit_code);

}  // namespace eigengrasp::cli
