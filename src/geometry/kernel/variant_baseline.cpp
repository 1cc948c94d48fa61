// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernels for any processor; see CMakeLists.txt for the options that this file alone is compiled with.
#include "core/lanes_baseline.hpp"
#include "geometry/kernel/look_at_balls.hpp"
#include "geometry/kernel/look_at_boxes.hpp"
#include "geometry/kernel/look_at_points.hpp"
#include "geometry/kernel/measure_blocks.hpp"

namespace eigengrasp::box_kernel {

const Functions baseline_functions = {gaps<kernel::Baseline>, times<kernel::Baseline>};

}  // namespace eigengrasp::box_kernel

namespace eigengrasp::ball_kernel {

const Functions baseline_functions = {times<kernel::Baseline>};

}  // namespace eigengrasp::ball_kernel

namespace eigengrasp::point_kernel {

const Functions baseline_functions = {reach_box<kernel::Baseline>, meet_triangle<kernel::Baseline>};

}  // namespace eigengrasp::point_kernel

namespace eigengrasp::block_kernel {

const Functions baseline_functions = {keep<kernel::Baseline>, measure<kernel::Baseline>};

}  // namespace eigengrasp::block_kernel
