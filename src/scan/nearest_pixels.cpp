// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "scan/nearest_pixels.hpp"

#include <cmath>
#include <cstddef>

namespace eigengrasp {

double pixel_distance(int a, int b, int columns) {
  return std::hypot(a % columns - b % columns, a / columns - b / columns);
}

std::vector<int> nearest_pixels(const std::vector<char>& marked, int columns) {
  const int count = static_cast<int>(marked.size()), rows = count / columns;
  std::vector<int> nearest(marked.size(), -1);
  const auto at = [&](int i) -> int& { return nearest[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < count; ++i)
    if (marked[static_cast<std::size_t>(i)] != 0) at(i) = i;
  const auto offer = [&](int x, int y, int dx, int dy) {
    if (x + dx < 0 || x + dx >= columns || y + dy < 0 || y + dy >= rows) return;
    const int i = y * columns + x, other = at((y + dy) * columns + x + dx);
    if (other >= 0 && (at(i) < 0 || pixel_distance(i, other, columns) < pixel_distance(i, at(i), columns)))
      at(i) = other;
  };
  for (const int way : {-1, 1}) {
    for (int k = 0; k < rows; ++k) {
      const int y = way < 0 ? k : rows - 1 - k;
      for (int x = 0; x < columns; ++x)
        for (const int dx : {-1, 0, 1}) offer(x, y, dx, way);
      for (int x = 0; x < columns; ++x) offer(x, y, -1, 0);
      for (int x = columns - 1; x >= 0; --x) offer(x, y, 1, 0);
    }
  }
  return nearest;
}

}  // namespace eigengrasp
