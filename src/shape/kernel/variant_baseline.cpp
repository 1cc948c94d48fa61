// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernel for any processor; see CMakeLists.txt for the options that this file alone is compiled with.
#include "shape/kernel/add_block.hpp"

namespace eigengrasp::moment_kernel {

const AddBlock add_block_baseline = add_block<2>;

}  // namespace eigengrasp::moment_kernel
