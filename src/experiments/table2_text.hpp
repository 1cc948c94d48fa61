// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/experiments/table2.hpp"

namespace eigengrasp {

/// "Barrett", "DLR", "Robonaut", "human".
const char* title_of(PaperHand hand);
/// "the paper's search", "our search".
const char* title_of(SearchKind search);
/// "materials of the models", "mu = 1".
const char* title_of(FrictionCase friction);
/// "the paper's search, mu = 1".
std::string title_of(const Table2Part& part);

}  // namespace eigengrasp
