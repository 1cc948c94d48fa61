// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The kernel for AVX-512; see CMakeLists.txt for the options that this file alone is compiled with.
#include "shape/kernel/add_block.hpp"

namespace eigengrasp::moment_kernel {

const AddBlock add_block_avx512 = add_block<8>;

}  // namespace eigengrasp::moment_kernel
