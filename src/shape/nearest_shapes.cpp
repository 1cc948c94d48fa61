// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/shape/nearest_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "shape/descriptor_row.hpp"

namespace eigengrasp {

NearestShapes::NearestShapes(std::size_t dimension) : dimension_(dimension), stride_(row_stride(dimension)) {
  if (dimension == 0) throw std::logic_error("descriptors without numbers");
}

void NearestShapes::add(const std::vector<float>& descriptor) {
  const std::vector<float> row = checked_row(descriptor, dimension_);
  rows_.insert(rows_.end(), row.begin(), row.end());
  ++size_;
}

std::vector<float> NearestShapes::descriptor(std::size_t index) const {
  if (index >= size_) throw std::logic_error("no descriptor of that index");
  const float* row = rows_.data() + index * stride_;
  return {row, row + dimension_};
}

std::vector<NearShape> NearestShapes::find_nearest(const std::vector<float>& descriptor,
                                                   std::size_t count) const {
  const std::vector<float> query = checked_row(descriptor, dimension_);
  std::vector<std::pair<float, std::size_t>> all(size_);
  for (std::size_t i = 0; i < size_; ++i)
    all[i] = {squared_distance(query.data(), rows_.data() + i * stride_, stride_), i};
  count = std::min(count, size_);
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(count);
  if (count < size_) std::nth_element(all.begin(), end, all.end());
  std::sort(all.begin(), end);
  std::vector<NearShape> nearest;
  for (auto it = all.begin(); it != end; ++it)
    nearest.push_back({it->second, std::sqrt(static_cast<double>(it->first))});
  return nearest;
}

}  // namespace eigengrasp
