// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/grasp_file_import.hpp"

#include <algorithm>

#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/database/graspable_size.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace eigengrasp {

namespace {

const GraspSource source{"eigengrasp plan", "grasps of files that 'eigengrasp plan' wrote"};

/// The object at scale 1; its one scale is that of the file.
StoredModel model_record(const ObjectRecord& object) {
  if (file_digest(object.source.path) != object.source.digest)
    fail("{}: has changed since the grasps were planned", object.source.path);
  ObjectReadOptions options;
  options.units = object.units;
  const ObjectModel at_one = load_object(object.source.path, options);
  StoredModel model;
  model.name = object.name;
  model.geometry_path = std::filesystem::absolute(object.source.path).lexically_normal().string();
  model.content_hash = content_hash(read_text_file(object.source.path));
  model.rescale = unit_length(object.units);
  model.approximate_radius = approximate_radius(at_one.mesh, at_one.center_of_mass);
  model.scales = {object.scale};
  return model;
}

/// The store's own record where it has the object already, with the scale that it lacks.
void add_object(const ObjectRecord& object, GraspStore& store) {
  StoredModel model = model_record(object);
  for (const StoredModel& there : store.models()) {
    if (there.name != model.name) continue;
    if (there.content_hash != model.content_hash || there.rescale != model.rescale)
      fail("{}: holds another object '{}'", store.place(), model.name);
    model = there;
    if (std::find(model.scales.begin(), model.scales.end(), object.scale) == model.scales.end())
      model.scales.insert(std::upper_bound(model.scales.begin(), model.scales.end(), object.scale),
                          object.scale);
  }
  store.add_model(model);
}

}  // namespace

std::size_t import_grasp_file(const GraspFile& file, GraspStore& store) {
  if (!file.obstacles.empty())
    fail("the grasps were planned among {} obstacles, which a store does not keep", file.obstacles.size());
  add_object(file.object, store);
  store.add_hand(hand_record(load_hand(file.hand.source.path)));
  store.add_source(source);
  std::vector<StoredGrasp> grasps;
  for (Grasp g : file.result.grasps) {
    g.object_scale = file.object.scale;
    grasps.push_back({0, source.name, std::move(g)});
  }
  store.add_grasps({file.object.name, file.object.scale, file.hand.name}, grasps);
  return grasps.size();
}

}  // namespace eigengrasp
