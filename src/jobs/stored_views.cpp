// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/stored_views.hpp"

#include <cmath>
#include <set>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/jobs/stored_shapes.hpp"
#include "eigengrasp/render/depth_camera.hpp"

namespace eigengrasp {

namespace {

constexpr int kPixels = 64;  // along each side: a view then has at most 8,000 triangles

std::vector<Vec3> icosahedron_corners() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> corners;
  for (const double one : {-1.0, 1.0})
    for (const double long_side : {-golden, golden}) {
      corners.emplace_back(0.0, one, long_side);
      corners.emplace_back(one, long_side, 0.0);
      corners.emplace_back(long_side, 0.0, one);
    }
  for (Vec3& corner : corners) corner.normalize();
  return corners;
}

std::vector<TriangleMesh> seen_from_all_sides(const TriangleMesh& mesh) {
  std::vector<DepthCamera> cameras;
  for (const Vec3& corner : icosahedron_corners()) {
    DepthCamera camera;
    camera.camera = frame_camera(bounding_box(mesh), -corner, Vec3::UnitZ());
    camera.columns = camera.rows = kPixels;
    cameras.push_back(camera);
  }
  return take_surface_views(mesh, cameras);
}

}  // namespace

StoredDescriptor describe_views(const std::string& model, const TriangleMesh& mesh) {
  require_sound_mesh(mesh, model);
  const Box box = bounding_box(mesh);
  StoredDescriptor record;
  record.model = model;
  record.function = kViewsFunction;
  record.route = to_string(DescriptorRoute::voxels);
  record.center = box.center();
  record.radius = 0.5 * box.diagonal();
  for (const TriangleMesh& view : seen_from_all_sides(mesh)) {
    if (view.triangles.empty()) continue;
    const std::vector<double> invariants = describe_object(view).invariants;
    record.invariants.insert(record.invariants.end(), invariants.begin(), invariants.end());
  }
  if (record.invariants.empty()) fail("nothing is seen of '{}' from any side", model);
  return record;
}

StoredViews::StoredViews(GraspStore& store) : views_(kDescriptorSize) {
  for (const StoredDescriptor& record : store.descriptors(kViewsFunction)) {
    if (record.invariants.empty() || record.invariants.size() % kDescriptorSize != 0)
      fail("the stored views of '{}' are damaged: {} numbers, expected a multiple of {}", record.model,
           record.invariants.size(), kDescriptorSize);
    StoredDescriptor view = record;
    view.function = to_string(ShapeFunction::surface);
    for (auto first = record.invariants.begin(); first != record.invariants.end(); first += kDescriptorSize) {
      view.invariants.assign(first, first + kDescriptorSize);
      views_.add(read_descriptor(view).values);
      owners_.push_back(names_.size());
    }
    names_.push_back(record.model);
  }
}

std::vector<std::pair<std::string, double>> StoredViews::rank(const std::vector<float>& values,
                                                              const std::vector<std::string>& without) const {
  std::vector<std::pair<std::string, double>> ranked;
  std::set<std::string> done(without.begin(), without.end());
  for (const NearShape& near : views_.find_nearest(values, views_.size())) {
    const std::string& name = names_[owners_[near.index]];
    if (done.insert(name).second) ranked.emplace_back(name, near.distance);
  }
  return ranked;
}

}  // namespace eigengrasp
