// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/experiments/table2.hpp"

namespace eigengrasp {

/// "the paper's search", "our search".
const char* title_of(SearchKind search);
/// "the models' materials", "mu = 1".
const char* title_of(FrictionCase friction);

}  // namespace eigengrasp
