// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/object_model.hpp"

#include <algorithm>
#include <utility>

#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"

namespace eigengrasp {

ObjectModel make_object(std::string name, TriangleMesh mesh, const Vec3* center_of_mass) {
  require_sound_mesh(mesh, name);
  const MeshReport report = inspect_mesh(mesh);
  ObjectModel object;
  if (center_of_mass != nullptr && !center_of_mass->allFinite())
    fail("{}: the centre of mass is not finite, expected three numbers in metres", name);
  object.center_of_mass = center_of_mass != nullptr ? *center_of_mass : report.center_of_mass();
  object.watertight = report.watertight;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      object.max_radius = std::max(object.max_radius, (mesh.corner(t, k) - object.center_of_mass).norm());
  object.bvh = MeshBvh(mesh);
  object.content_key = content_key_of(mesh);
  object.name = std::move(name);
  object.mesh = std::move(mesh);
  return object;
}

ObjectModel rescaled(const ObjectModel& object, double factor) {
  ObjectModel result = object;
  if (!result.at_one) result.at_one = std::make_shared<const MeshBvh>(object.bvh);
  transform(result.mesh, Pose::Identity(), factor);
  if (object.seen) {
    TriangleMesh seen = *object.seen;
    transform(seen, Pose::Identity(), factor);
    result.seen = std::make_shared<const TriangleMesh>(std::move(seen));
  }
  result.bvh = MeshBvh(result.mesh);
  result.center_of_mass *= factor;
  result.max_radius *= factor;
  result.scale *= factor;
  return result;
}

std::string content_key_of(const TriangleMesh& mesh) {
  const auto bytes = [](const auto& values) {
    return std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  };
  return content_hash(content_hash(bytes(mesh.vertices)) + content_hash(bytes(mesh.triangles)));
}

}  // namespace eigengrasp
