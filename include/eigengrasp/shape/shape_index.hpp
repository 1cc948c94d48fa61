// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "eigengrasp/shape/nearest_shapes.hpp"

namespace eigengrasp {

struct ShapeIndexOptions {
  int links = 16;         ///< of a descriptor to near ones, in [2, 100]; memory grows with it
  int build_width = 100;  ///< candidates that are kept while a descriptor is put in, in [links, 10000]
  int threads = 1;        ///< 0: all. The index is the same every time only with 1
  unsigned seed = 1;

  /// Sentences about what is out of bounds; empty where all is well.
  std::vector<std::string> validate() const;
};

/// Approximate nearest neighbours among very many descriptors: a hierarchical navigable small world graph
/// (Malkov and Yashunin 2020; hnswlib). Below about 100,000 descriptors NearestShapes is as quick, and exact.
/// Memory: 0.7 kB a descriptor of 121 numbers. Immutable; any number of threads may search.
class ShapeIndex {
 public:
  /// Cost: 0.5-1 ms a descriptor and thread. @throws Error where there is none, or options.validate() objects
  explicit ShapeIndex(const NearestShapes& shapes, const ShapeIndexOptions& options = {});
  /// Reads what save() wrote. @throws Error for a file that is missing, cut, changed, or of another version
  static ShapeIndex load(const std::filesystem::path& file);
  ShapeIndex(ShapeIndex&&) noexcept;
  ShapeIndex& operator=(ShapeIndex&&) noexcept;
  ~ShapeIndex();

  std::size_t size() const;
  std::size_t dimension() const;

  /// Writes FILE and FILE.sum, which tells whether FILE is whole. @throws Error where they cannot be written
  void save(const std::filesystem::path& file) const;

  /// The count nearest ones that are found, nearest first. @param width candidates that are kept while
  /// searching, at least count: more take longer and find more; docs/results/psb-retrieval.md has figures.
  /// @throws Error where the descriptor has another size or a number that is not finite
  std::vector<NearShape> find_nearest(const std::vector<float>& descriptor, std::size_t count,
                                      std::size_t width = 100) const;

 private:
  class Graph;
  explicit ShapeIndex(std::unique_ptr<Graph> graph);
  std::unique_ptr<Graph> graph_;
};

}  // namespace eigengrasp
