// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/core/version.hpp"

namespace eigengrasp {

const char* version() {
  return EIGENGRASP_VERSION;
}

}  // namespace eigengrasp
