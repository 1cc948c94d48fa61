// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/shape/zernike_moments.hpp"

#include <cmath>
#include <stdexcept>

namespace eigengrasp {

ZernikeMoments::ZernikeMoments(int order) : order_(order) {
  if (order < 0 || order > kMaxZernikeOrder) throw std::logic_error("Zernike order out of range");
  std::size_t count = 0;
  for (int l = 0; l <= order; ++l) {
    first_.push_back(count);
    count += static_cast<std::size_t>(((order - l) / 2 + 1) * (2 * l + 1));
  }
  values_.assign(count, 0.0);
}

std::vector<double> ZernikeMoments::invariants() const {
  std::vector<double> norms;
  norms.reserve(zernike_invariant_count(order_));
  for (int n = 0; n <= order_; ++n)
    for (int l = n % 2; l <= n; l += 2) {
      double sum = 0.0;
      for (int m = -l; m <= l; ++m) sum += (*this)(n, l, m) * (*this)(n, l, m);
      norms.push_back(std::sqrt(sum));
    }
  return norms;
}

std::size_t zernike_invariant_count(int order) {
  std::size_t count = 0;
  for (int n = 0; n <= order; ++n) count += static_cast<std::size_t>(n / 2 + 1);
  return count;
}

}  // namespace eigengrasp
