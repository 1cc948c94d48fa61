// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for AVX-512; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_avx512.hpp"
#include "planning/kernel/evaluate.hpp"
#include "planning/kernel/propose.hpp"

namespace eigengrasp::kernel {

const Functions avx512_functions = {evaluate<Avx512>, propose<Avx512>, clear_itself<Avx512>};

}  // namespace eigengrasp::kernel
