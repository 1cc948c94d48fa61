// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/core/instruction_set.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace eigengrasp {

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      return "baseline";
    case InstructionSet::avx2:
      return "AVX2";
    case InstructionSet::avx512:
      return "AVX-512";
  }
  throw std::logic_error("unknown instruction set");
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) sets.push_back(InstructionSet::avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

namespace {

InstructionSet choose() {
  const auto sets = available_instruction_sets();
  const char* const asked = std::getenv("EIGENGRASP_SIMD");
  const std::string_view name = asked ? asked : "";
  const auto wanted = name == "baseline" ? InstructionSet::baseline
                      : name == "avx2"   ? InstructionSet::avx2
                                         : InstructionSet::avx512;
  return std::find(sets.begin(), sets.end(), wanted) != sets.end() ? wanted : sets.back();
}

}  // namespace

InstructionSet best_instruction_set() {
  static const InstructionSet set = choose();
  return set;
}

}  // namespace eigengrasp
