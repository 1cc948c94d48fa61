// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/triangle_rule.hpp"

#include "shape/gauss_rule.hpp"

namespace eigengrasp {

namespace {

TriangleRule conical_product(int along, int across) {
  TriangleRule rule;
  for (const GaussNode& u : gauss_rule(along, 1))
    for (const GaussNode& t : gauss_rule(across, 0))
      rule.nodes.push_back({u.x, t.x * (1.0 - u.x), u.weight * t.weight});
  return rule;
}

}  // namespace

const TriangleRule& triangle_rule(int along, int across) {
  static const auto rules = [] {
    std::vector<std::vector<TriangleRule>> all(kMaxRuleSide);
    for (int i = 1; i <= kMaxRuleSide; ++i)
      for (int k = 1; k <= kMaxRuleSide; ++k)
        all[static_cast<std::size_t>(i - 1)].push_back(conical_product(i, k));
    return all;
  }();
  return rules.at(static_cast<std::size_t>(along - 1)).at(static_cast<std::size_t>(across - 1));
}

}  // namespace eigengrasp
