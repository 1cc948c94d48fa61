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

/// The conical product of two Gauss rules: `along` nodes from the side ac to the corner b, exact to degree
/// 2 along - 1, times `across` nodes on lines parallel to ac, exact to degree 2 across - 1 (Stroud 1971).
/// @pre both in [1, kMaxRuleSide]
const TriangleRule& triangle_rule(int along, int across);

}  // namespace eigengrasp
