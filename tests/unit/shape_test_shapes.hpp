// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <Eigen/Geometry>

#include "eigengrasp/core/random.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"
#include "unit/geometry_shapes.hpp"

namespace eigengrasp::testing {

/// Box with the given middle.
inline TriangleMesh box_about(const Vec3& size, const Vec3& middle) {
  TriangleMesh mesh = box_shape(size);
  for (Vec3& v : mesh.vertices) v += middle - 0.5 * size;
  return mesh;
}

/// Three bars of different lengths that meet in a corner: closed pieces, no symmetry, unlike its mirror
/// image.
inline TriangleMesh chiral_shape() {
  TriangleMesh mesh = box_about({1.0, 0.2, 0.2}, {0.5, 0.0, 0.0});
  append(mesh, box_about({0.2, 0.6, 0.2}, {0.9, 0.4, 0.0}));
  append(mesh, box_about({0.2, 0.2, 0.4}, {0.1, 0.0, 0.3}));
  return mesh;
}

inline Mat3 random_rotation(RandomStream& stream) {
  Eigen::Quaterniond q(stream.normal(), stream.normal(), stream.normal(), stream.normal());
  return q.normalized().toRotationMatrix();
}

inline TriangleMesh moved(TriangleMesh mesh, const Mat3& R, double scale, const Vec3& shift) {
  for (Vec3& v : mesh.vertices) v = scale * (R * v) + shift;
  return mesh;
}

}  // namespace eigengrasp::testing
