// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

namespace eigengrasp {

/// Which vector instructions the hot kernels use. All variants give the same bits.
enum class InstructionSet { baseline, avx2, avx512 };

/// "baseline", "AVX2", "AVX-512".
const char* name_of(InstructionSet set);

/// Those that this processor (and this build) has, from baseline upwards.
std::vector<InstructionSet> available_instruction_sets();

/// The last of the available ones, or the one that the environment variable EIGENGRASP_SIMD names (baseline,
/// avx2, avx512), where it is available. Decided once a process.
InstructionSet best_instruction_set();

}  // namespace eigengrasp
