// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <vector>

namespace eigengrasp {

/// Numbers a row: the dimension, filled up to a multiple of 16.
constexpr std::size_t row_stride(std::size_t dimension) {
  return (dimension + 15) / 16 * 16;
}

/// A descriptor with zeros up to the stride. @throws Error where it has another size than the dimension, or a
/// number that is not finite
std::vector<float> checked_row(const std::vector<float>& descriptor, std::size_t dimension);

/// Of two rows; sixteen partial sums, so that any processor's registers are filled and the bits are the same.
/// @pre stride is a multiple of 16
float squared_distance(const float* a, const float* b, std::size_t stride);

}  // namespace eigengrasp
