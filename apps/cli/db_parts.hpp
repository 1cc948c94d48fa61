// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/database/grasp_store.hpp"

namespace eigengrasp::cli {

inline constexpr const char* kStoreHelp =
    "sqlite:FILE, text:FOLDER or postgresql://USER:PASSWORD@HOST/DATABASE";
inline constexpr const char* kStoreToReadHelp =
    "sqlite:FILE, text:FOLDER, postgresql://USER:PASSWORD@HOST/DATABASE, or 'shipped': grasps of the shipped "
    "objects";

/// A store that must be there, or the shipped one; nothing of it is changed.
std::unique_ptr<GraspStore> open_to_read(const std::string& address);
/// A store that is made where it is missing. Says on stderr where it waits for a server.
/// @param await_server also where none answers now: one that starts again
std::unique_ptr<GraspStore> open_to_write(const std::string& address, bool await_server = false);

/// A store that must be there, to be added to.
inline std::unique_ptr<GraspStore> open_to_update(const std::string& address) {
  return open_store(address, {.access = StoreAccess::update});
}

/// What a build on a Slurm cluster is given.
struct SlurmChoice {
  std::vector<std::string> sbatch_options;  ///< such as --partition=cpu
  std::vector<std::string> build_options;   ///< of the jobs' `db build --only-waiting`
};
/// Submits a job array whose jobs build what waits in a store. @throws Error where sbatch is missing or
/// refuses
void submit_to_slurm(const std::string& store, const SlurmChoice& choice);

// Each adds a command of 'eigengrasp db'.
void add_db_build(CLI::App& db, int& exit_code);
void add_db_status(CLI::App& db);
void add_db_stats(CLI::App& db);
void add_db_describe(CLI::App& db, int& exit_code);
void add_db_verify(CLI::App& db, int& exit_code);
// Commands of 'eigengrasp reproduce'.
void add_reproduce_table3(CLI::App& reproduce);
void add_reproduce_figure12(CLI::App& reproduce, int& exit_code);
void add_reproduce_partial(CLI::App& reproduce, int& exit_code);

}  // namespace eigengrasp::cli
