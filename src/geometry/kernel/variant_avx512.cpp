// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for AVX-512; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_avx512.hpp"
#include "geometry/kernel/look_at_balls.hpp"
#include "geometry/kernel/look_at_boxes.hpp"
#include "geometry/kernel/look_at_points.hpp"
#include "geometry/kernel/measure_blocks.hpp"

namespace eigengrasp::box_kernel {

const Functions avx512_functions = {gaps<kernel::Avx512>, times<kernel::Avx512>};

}  // namespace eigengrasp::box_kernel

namespace eigengrasp::ball_kernel {

const Functions avx512_functions = {times<kernel::Avx512>};

}  // namespace eigengrasp::ball_kernel

namespace eigengrasp::point_kernel {

const Functions avx512_functions = {reach_box<kernel::Avx512>, meet_triangle<kernel::Avx512>};

}  // namespace eigengrasp::point_kernel

namespace eigengrasp::block_kernel {

const Functions avx512_functions = {keep<kernel::Avx512>, measure<kernel::Avx512>};

}  // namespace eigengrasp::block_kernel
