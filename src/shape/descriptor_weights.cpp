// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cmath>

#include "eigengrasp/shape/shape_descriptor.hpp"

namespace eigengrasp {

const std::vector<double>& descriptor_weights() {
  static const auto weights = [] {
    std::vector<double> all;
    for (int n = 0; n <= kDescriptorOrder; ++n)
      for (int l = n % 2; l <= n; l += 2) {
        const double u = n / 20.0 - 0.5, v = l / 20.0 - 0.5;
        all.push_back(std::exp(1.2 * u + 2.4 * v + 0.4 * u * u - 1.1 * u * v + 2.5 * v * v));
      }
    return all;
  }();
  return weights;
}

}  // namespace eigengrasp
