// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/triangle_rule.hpp"

#include "shape/gauss_rule.hpp"

namespace eigengrasp {

namespace {

TriangleRule conical_product(int side) {
  TriangleRule rule;
  for (const auto& [u, weight_u] : gauss_rule(side, 1))
    for (const auto& [t, weight_t] : gauss_rule(side, 0))
      rule.nodes.push_back({u, t * (1.0 - u), weight_u * weight_t});
  return rule;
}

}  // namespace

const TriangleRule& triangle_rule(int side) {
  static const auto rules = [] {
    std::vector<TriangleRule> all;
    for (int n = 1; n <= kMaxRuleSide; ++n) all.push_back(conical_product(n));
    return all;
  }();
  return rules.at(static_cast<std::size_t>(side - 1));
}

}  // namespace eigengrasp
