// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for AVX2; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_avx2.hpp"
#include "planning/kernel/evaluate.hpp"
#include "planning/kernel/propose.hpp"

namespace eigengrasp::kernel {

const Functions avx2_functions = {evaluate<Avx2>, propose<Avx2>, clear_itself<Avx2>};

}  // namespace eigengrasp::kernel
