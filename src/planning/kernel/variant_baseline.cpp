// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for any processor; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_baseline.hpp"
#include "planning/kernel/evaluate.hpp"
#include "planning/kernel/propose.hpp"

namespace eigengrasp::kernel {

const Functions baseline_functions = {evaluate<Baseline>, propose<Baseline>, clear_itself<Baseline>};

}  // namespace eigengrasp::kernel
