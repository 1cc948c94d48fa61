// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/machine.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "eigengrasp/core/instruction_set.hpp"
#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/core/version.hpp"

namespace eigengrasp {

namespace {

/// The text behind "KEY:" of a file of /proc; empty where there is none.
std::string proc_value(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t colon = line.find(':');
    const std::size_t begin = colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? std::string() : line.substr(begin);
  }
  return {};
}

/// "1234 kB" of a file of /proc.
double proc_bytes(const char* file, const std::string& key) {
  return 1024.0 * std::strtod(proc_value(file, key).c_str(), nullptr);
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.processor = proc_value("/proc/cpuinfo", "model name");
  if (machine.processor.empty()) machine.processor = "unknown processor";
  machine.threads = hardware_threads();
  machine.memory = proc_bytes("/proc/meminfo", "MemTotal");
  machine.instruction_set = name_of(best_instruction_set());
  return machine;
}

std::string describe(const Machine& machine) {
  std::string text = fmt::format("{}, {} threads", machine.processor, machine.threads);
  if (machine.memory > 0.0) text += fmt::format(", {:.0f} GB", std::ceil(machine.memory / 1e9));
  if (!machine.instruction_set.empty()) text += ", " + machine.instruction_set;
  return text;
}

ExperimentRecord make_record(const std::string& command) {
  return {this_machine(), version(), command};
}

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::int64_t peak_memory() {
  return static_cast<std::int64_t>(proc_bytes("/proc/self/status", "VmHWM"));
}

}  // namespace eigengrasp
