// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

namespace eigengrasp {

/// Version of the program, as in the project's CMakeLists.txt.
const char* version();

}  // namespace eigengrasp
