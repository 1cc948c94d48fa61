// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/object_model.hpp"

#include <algorithm>
#include <utility>

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
  object.name = std::move(name);
  object.mesh = std::move(mesh);
  return object;
}

}  // namespace eigengrasp
