// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for AVX2; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_avx2.hpp"
#include "geometry/kernel/look_at_boxes.hpp"

namespace eigengrasp::box_kernel {

const Functions avx2_functions = {gaps<kernel::Avx2>, times<kernel::Avx2>};

}  // namespace eigengrasp::box_kernel
