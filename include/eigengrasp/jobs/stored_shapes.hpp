// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "eigengrasp/database/grasp_store.hpp"
#include "eigengrasp/shape/nearest_shapes.hpp"
#include "eigengrasp/shape/shape_descriptor.hpp"

namespace eigengrasp {

/// Name of the distance between descriptors in a store.
inline constexpr const char* kZernikeDistance = "zernike";

StoredDescriptor descriptor_record(const std::string& model, const ShapeDescriptor& descriptor);
/// @throws Error where it is no descriptor of this program
ShapeDescriptor read_descriptor(const StoredDescriptor& record);

/// The surface descriptor of a mesh as stores hold them: flat ones too.
ShapeDescriptor describe_object(const TriangleMesh& mesh);

/// The described objects of a store, ready to be searched. Immutable, shared by all threads.
class StoredShapes {
 public:
  /// Cost: 20 ms for 2,000 objects. @throws Error for a damaged descriptor
  explicit StoredShapes(GraspStore& store);

  std::size_t size() const { return names_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  bool holds(const std::string& model) const { return places_.contains(model); }
  /// @pre holds(model)
  std::vector<float> values(const std::string& model) const { return shapes_.descriptor(places_.at(model)); }
  /// The nearest ones but for those left out, nearest first. @param without names
  std::vector<std::pair<std::string, double>> find_nearest(const std::vector<float>& values,
                                                           std::size_t count,
                                                           const std::vector<std::string>& without) const;

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> places_;
  NearestShapes shapes_;
};

}  // namespace eigengrasp
