// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

namespace eigengrasp {

struct GaussNode {
  double x = 0.0;       ///< in (0, 1)
  double weight = 0.0;  ///< > 0
};

/// Gauss's rule on [0, 1] for the weight (1 - x)^alpha, alpha 0 or 1, exact to degree 2 count - 1. The
/// weights add up to 1. @pre count >= 1
std::vector<GaussNode> gauss_rule(int count, int alpha);

}  // namespace eigengrasp
