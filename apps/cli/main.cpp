// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>

#include "cli/commands.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/version.hpp"

namespace {

/// CLI11's own codes are above 100; ours is 2 for whatever is wrong with the call.
int report(const CLI::App& app, const CLI::ParseError& e) {
  if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
  const CLI::App* command = &app;                  // the innermost that was named
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  if (const auto extra = command->remaining(); !extra.empty() && command->get_require_subcommand_min() > 0) {
    fmt::print(stderr, "eigengrasp: there is no command '{}' (see '{} --help')\n", extra.front(),
               command == &app ? "eigengrasp" : "eigengrasp " + command->get_name());
    return eigengrasp::cli::bad_input;
  }
  fmt::print(stderr, "eigengrasp: {} (see 'eigengrasp --help', or --help after the command)\n", e.what());
  return eigengrasp::cli::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Finds stable grasps for dexterous hands.", "eigengrasp"};
  app.set_version_flag("--version", eigengrasp::version());
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  eigengrasp plan glass --hand human\n"
      "  eigengrasp plan part.stl --units mm --hand barrett-rubber --table auto --out grasps\n"
      "  eigengrasp hand list\n"
      "  eigengrasp render grasps/grasps.json --png best.png\n"
      "  eigengrasp db add-objects sqlite:grasps.db meshes --units mm");
  int exit_code = eigengrasp::cli::success;
  eigengrasp::cli::add_plan_command(app, exit_code);
  eigengrasp::cli::add_transfer_command(app, exit_code);
  eigengrasp::cli::add_evaluate_command(app);
  eigengrasp::cli::add_quality_command(app);
  eigengrasp::cli::add_render_command(app);
  eigengrasp::cli::add_hand_command(app, exit_code);
  eigengrasp::cli::add_object_command(app);
  eigengrasp::cli::add_scan_command(app);
  eigengrasp::cli::add_shape_command(app);
  eigengrasp::cli::add_bench_command(app, exit_code);
  eigengrasp::cli::add_online_bench_command(app, exit_code);
  eigengrasp::cli::add_reproduce_command(app, exit_code);
  eigengrasp::cli::add_serve_command(app);
  eigengrasp::cli::add_replay_command(app, exit_code);
  eigengrasp::cli::add_db_command(app, exit_code);
  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
    fmt::print(stderr, "eigengrasp: the standard output cannot be written ({})\n", std::strerror(errno));
  } catch (const CLI::ParseError& e) {
    return report(app, e);
  } catch (const eigengrasp::Error& e) {
    fmt::print(stderr, "eigengrasp: {}\n", e.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "eigengrasp: out of memory; is the input very large?\n");
  } catch (const std::exception& e) {
    fmt::print(stderr, "eigengrasp: {}\n", e.what());
  }
  return eigengrasp::cli::bad_input;
}
