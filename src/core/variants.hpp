// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/core/instruction_set.hpp"

namespace eigengrasp {

/// Of the variants of a kernel that for an instruction set.
template <class Functions>
const Functions& variant_of(InstructionSet set, const Functions& baseline, const Functions& avx2,
                            const Functions& avx512) {
  switch (set) {
    case InstructionSet::avx512:
      return avx512;
    case InstructionSet::avx2:
      return avx2;
    case InstructionSet::baseline:
      break;
  }
  return baseline;
}

/// The functions of the kernel in that namespace; where there are no other variants, the baseline's.
#if defined(__x86_64__)
#define EIGENGRASP_VARIANT(kernel, set)                                               \
  ::eigengrasp::variant_of((set), kernel::baseline_functions, kernel::avx2_functions, \
                           kernel::avx512_functions)
#else
#define EIGENGRASP_VARIANT(kernel, set) (static_cast<void>(set), kernel::baseline_functions)
#endif

}  // namespace eigengrasp
