// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

namespace eigengrasp {

/// Points and weights that integrate polynomials over a triangle a, b, c: the point is a + u (b - a) + v (c -
/// a), the weights add up to 1 and are positive.
struct TriangleRule {
  struct Node {
    double u, v, weight;
  };
  std::vector<Node> nodes;
};

inline constexpr int kMaxRuleSide = 21;

/// The conical product of two Gauss rules with side^2 nodes, exact to degree 2 side - 1 (Stroud 1971).
/// @pre side in [1, kMaxRuleSide]
const TriangleRule& triangle_rule(int side);

}  // namespace eigengrasp
