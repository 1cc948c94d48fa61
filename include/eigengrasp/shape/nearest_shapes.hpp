// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <vector>

namespace eigengrasp {

/// A shape near to another one.
struct NearShape {
  std::size_t index = 0;  ///< in the order in which the descriptors were added
  double distance = 0.0;  ///< Euclidean, of the descriptors

  bool operator==(const NearShape&) const = default;
};

/// Exact nearest neighbours among descriptors: every one is looked at, in single precision.
class NearestShapes {
 public:
  /// @pre dimension >= 1
  explicit NearestShapes(std::size_t dimension);

  /// @throws Error where the descriptor has another size or a number that is not finite
  void add(const std::vector<float>& descriptor);

  std::size_t size() const { return size_; }
  std::size_t dimension() const { return dimension_; }
  std::vector<float> descriptor(std::size_t index) const;

  /// The count nearest ones (all, where there are fewer), nearest first; of equally near ones that of the
  /// lower index. The same on every processor. Cost: 0.05 us a descriptor of 121 numbers. @throws Error as
  /// add
  std::vector<NearShape> find_nearest(const std::vector<float>& descriptor, std::size_t count) const;

 private:
  std::size_t dimension_ = 0;
  std::size_t stride_ = 0;  ///< numbers a row: the dimension and zeros up to a multiple of 16
  std::size_t size_ = 0;
  std::vector<float> rows_;
};

}  // namespace eigengrasp
