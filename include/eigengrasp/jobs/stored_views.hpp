// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "eigengrasp/database/grasp_store.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "eigengrasp/shape/nearest_shapes.hpp"

namespace eigengrasp {

/// Function of the record that holds the surface descriptors of all views of an object, one after the other.
inline constexpr const char* kViewsFunction = "surface-views";

/// Surface descriptors of what a camera sees of a mesh from the twelve corners of an icosahedron about it, so
/// that the scan of one side finds its like. The record's ball is about the mesh's box. Views in which
/// nothing is seen (plates from their edges) are left out. Cost: 0.3 s of a core.
/// @throws Error as compute_shape_descriptor, or where nothing is seen in any view
StoredDescriptor describe_views(const std::string& model, const TriangleMesh& mesh);

/// The views of a store's objects, ready to be searched. Immutable, shared by all threads.
class StoredViews {
 public:
  /// Cost: 0.3 s for 2,000 objects. @throws Error for a damaged descriptor
  explicit StoredViews(GraspStore& store);

  bool empty() const { return names_.empty(); }
  /// All objects but for those left out by the distance of their nearest view, nearest first. @param values
  /// of the surface descriptor of what was seen @param without names
  std::vector<std::pair<std::string, double>> rank(const std::vector<float>& values,
                                                   const std::vector<std::string>& without) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::size_t> owners_;  ///< of each view, in names_
  NearestShapes views_;
};

}  // namespace eigengrasp
