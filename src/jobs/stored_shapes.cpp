// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/stored_shapes.hpp"

#include <algorithm>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

StoredDescriptor descriptor_record(const std::string& model, const ShapeDescriptor& descriptor) {
  return {model,
          to_string(descriptor.function),
          to_string(descriptor.route),
          descriptor.ball.center,
          descriptor.ball.radius,
          descriptor.invariants};
}

ShapeDescriptor read_descriptor(const StoredDescriptor& record) {
  const DescriptorRoute route = record.route == to_string(DescriptorRoute::moments) ? DescriptorRoute::moments
                                                                                    : DescriptorRoute::voxels;
  try {
    return make_shape_descriptor(record.invariants, parse_shape_function(record.function), route,
                                 {record.center, record.radius});
  } catch (const Error& e) {
    fail("the stored descriptor of '{}' is damaged: {}", record.model, e.what());
  }
}

ShapeDescriptor describe_object(const TriangleMesh& mesh) {
  DescriptorOptions options;
  options.allow_flat = true;
  return compute_shape_descriptor(mesh, options);
}

StoredShapes::StoredShapes(GraspStore& store) : shapes_(kDescriptorSize) {
  for (const StoredDescriptor& record : store.descriptors(to_string(ShapeFunction::surface))) {
    shapes_.add(read_descriptor(record).values);
    places_.emplace(record.model, names_.size());
    names_.push_back(record.model);
  }
}

std::vector<std::pair<std::string, double>> StoredShapes::find_nearest(
    const std::vector<float>& values, std::size_t count, const std::vector<std::string>& without) const {
  std::vector<std::pair<std::string, double>> found;
  for (const NearShape& near : shapes_.find_nearest(values, count + without.size())) {
    const std::string& name = names_[near.index];
    if (std::find(without.begin(), without.end(), name) != without.end()) continue;
    if (found.size() == count) break;
    found.emplace_back(name, near.distance);
  }
  return found;
}

}  // namespace eigengrasp
