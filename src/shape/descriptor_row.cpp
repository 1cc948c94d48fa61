// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/descriptor_row.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

std::vector<float> checked_row(const std::vector<float>& descriptor, std::size_t dimension) {
  if (descriptor.size() != dimension)
    fail("a shape descriptor has {} numbers, expected {}", descriptor.size(), dimension);
  if (!std::all_of(descriptor.begin(), descriptor.end(), [](float x) { return std::isfinite(x); }))
    fail("a shape descriptor has a number that is not finite, expected finite ones");
  std::vector<float> row(descriptor);
  row.resize(row_stride(dimension), 0.0F);
  return row;
}

float squared_distance(const float* a, const float* b, std::size_t stride) {
  typedef float Sixteen __attribute__((vector_size(64)));  // NOLINT: an attribute of the compiler
  Sixteen sum = {};
  for (std::size_t i = 0; i < stride; i += 16) {
    Sixteen x, y;
    std::memcpy(&x, a + i, sizeof x);
    std::memcpy(&y, b + i, sizeof y);
    const Sixteen d = x - y;
    sum += d * d;
  }
  float total = 0.0F;
  for (int k = 0; k < 16; ++k) total += sum[k];
  return total;
}

}  // namespace eigengrasp
