// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for AVX-512; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_avx512.hpp"
#include "geometry/kernel/look_at_boxes.hpp"

namespace eigengrasp::box_kernel {

const Functions avx512_functions = {gaps<kernel::Avx512>, times<kernel::Avx512>};

}  // namespace eigengrasp::box_kernel
