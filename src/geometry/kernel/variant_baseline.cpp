// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for any processor; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_baseline.hpp"
#include "geometry/kernel/look_at_boxes.hpp"

namespace eigengrasp::box_kernel {

const Functions baseline_functions = {gaps<kernel::Baseline>, times<kernel::Baseline>};

}  // namespace eigengrasp::box_kernel
