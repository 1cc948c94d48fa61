// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for AVX2; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_avx2.hpp"
#include "geometry/kernel/look_at_balls.hpp"
#include "geometry/kernel/look_at_boxes.hpp"
#include "geometry/kernel/look_at_points.hpp"
#include "geometry/kernel/measure_blocks.hpp"

namespace eigengrasp::box_kernel {

const Functions avx2_functions = {gaps<kernel::Avx2>, times<kernel::Avx2>};

}  // namespace eigengrasp::box_kernel

namespace eigengrasp::ball_kernel {

const Functions avx2_functions = {times<kernel::Avx2>};

}  // namespace eigengrasp::ball_kernel

namespace eigengrasp::point_kernel {

const Functions avx2_functions = {reach_box<kernel::Avx2>, meet_triangle<kernel::Avx2>};

}  // namespace eigengrasp::point_kernel

namespace eigengrasp::block_kernel {

const Functions avx2_functions = {keep<kernel::Avx2>, measure<kernel::Avx2>};

}  // namespace eigengrasp::block_kernel
