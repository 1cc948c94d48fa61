// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/commands.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/version.hpp"

namespace {

/// CLI11's own codes are above 100; ours is 2 for whatever is wrong with the call.
int report(const CLI::App& app, const CLI::ParseError& e) {
  if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
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
      "  eigengrasp render grasps/grasps.json --png best.png");
  int exit_code = eigengrasp::cli::success;
  eigengrasp::cli::add_plan_command(app, exit_code);
  eigengrasp::cli::add_evaluate_command(app);
  eigengrasp::cli::add_quality_command(app);
  eigengrasp::cli::add_render_command(app);
  eigengrasp::cli::add_hand_command(app, exit_code);
  eigengrasp::cli::add_object_command(app);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& e) {
    return report(app, e);
  } catch (const eigengrasp::Error& e) {
    fmt::print(stderr, "eigengrasp: {}\n", e.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "eigengrasp: out of memory; is the input very large?\n");
  }
  return eigengrasp::cli::bad_input;
}
