// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "cli/db_parts.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/core/temporary_folder.hpp"

namespace eigengrasp::cli {

namespace {

constexpr const char* kStoreVariable = "EIGENGRASP_STORE";
constexpr int most_jobs = 1000;  // of an array, where the user does not say

/// As one word of a shell.
std::string quoted(const std::string& word) {
  std::string out(1, '\'');
  for (const char c : word) {
    if (c == '\'') {
      out.append("'\\''");
    } else {
      out.push_back(c);
    }
  }
  out.push_back('\'');
  return out;
}

/// The output of a command that ended well; none otherwise.
std::optional<std::string> output_of(const std::string& command) {
  std::FILE* const pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  if (::pclose(pipe) != 0) return std::nullopt;
  return text;
}

/// One job a processor of the cluster.
int jobs_of_cluster() {
  const auto text = output_of("sinfo --noheader --format=%C");  // allocated/idle/other/total
  if (!text) return hardware_threads();
  const std::size_t slash = text->rfind('/');
  const int processors = slash == std::string::npos ? 0 : std::atoi(text->c_str() + slash + 1);
  return std::clamp(processors, 1, most_jobs);
}

/// What each job of the array runs. The store comes by the environment, since its address may hold a
/// password.
std::string script(const SlurmChoice& choice) {
  std::string text = fmt::format(
      "#!/bin/sh\n#SBATCH --job-name=eigengrasp\n#SBATCH --array=1-{}\n#SBATCH --requeue\n"
      "#SBATCH --output=eigengrasp-%A_%a.log\n"
      "exec {} db build \"${}\" --only-waiting --jobs \"${{SLURM_CPUS_PER_TASK:-1}}\"",
      jobs_of_cluster(), quoted(std::filesystem::read_symlink("/proc/self/exe").string()), kStoreVariable);
  for (const std::string& word : choice.build_options) text.append(1, ' ').append(quoted(word));
  return text + "\n";
}

}  // namespace

void submit_to_slurm(const std::string& store, const SlurmChoice& choice) {
  if (!store.starts_with("postgresql:") && !store.starts_with("postgres:"))
    fail("--slurm: found a store that only this machine can use, expected postgresql://USER@HOST/DATABASE");
  if (!output_of("command -v sbatch"))
    fail(
        "--slurm: sbatch was not found; this machine must be able to submit to a Slurm cluster, or "
        "'scripts/local-slurm up FOLDER' makes one of it");
  const TemporaryFolder folder("slurm");
  const std::filesystem::path file = folder.path() / "eigengrasp.sh";
  write_file_atomically(file, script(choice));
  ::setenv(kStoreVariable, store.c_str(), 1);
  std::string command = "sbatch";
  for (const std::string& word : choice.sbatch_options) command.append(1, ' ').append(quoted(word));
  command.append(1, ' ').append(quoted(file.string()));
  std::fflush(stdout);
  if (std::system(command.c_str()) != 0)
    fail("--slurm: sbatch refused the job array; its own words are above");
  fmt::print(
      "'eigengrasp db status STORE' shows the progress; 'scancel' ends it, and the same command goes on\n");
}

}  // namespace eigengrasp::cli
