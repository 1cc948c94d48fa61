// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <string>

namespace eigengrasp {

/// What figures were measured on.
struct Machine {
  std::string processor;        ///< model name
  int threads = 0;              ///< that the machine has
  double memory = 0.0;          ///< [bytes]; 0 where unknown
  std::string instruction_set;  ///< that the planner uses, such as "AVX2"
};
Machine this_machine();
/// Such as "Xeon Gold 6248, 2 threads, 8 GB, AVX-512".
std::string describe(const Machine& machine);

/// How a result was made, so that it can be made again.
struct ExperimentRecord {
  Machine machine;
  std::string version;  ///< of the program
  std::string command;  ///< that makes the result
};
ExperimentRecord make_record(const std::string& command);

/// Forgets the peak so far, where the system allows that.
void reset_peak_memory();
/// Largest resident size of this process [bytes] since the start, or since the last reset; 0 where unknown.
std::int64_t peak_memory();

}  // namespace eigengrasp
