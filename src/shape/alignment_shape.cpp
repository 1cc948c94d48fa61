// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/shape/shape_alignment.hpp"
#include "shape/surface_points.hpp"

namespace eigengrasp {

namespace {

constexpr int n_points = 200;

/// Right-handed eigenvectors by falling eigenvalue.
void set_axes(AlignmentShape& shape, const Mat3& covariance) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(covariance);
  const Mat3& rising = solver.eigenvectors();
  shape.axes << rising.col(2), rising.col(1), rising.col(2).cross(rising.col(1));
  for (int k = 0; k < 3; ++k)
    shape.deviations[k] = std::sqrt(std::max(0.0, solver.eigenvalues()[2 - k])) / shape.size;
}

/// Spread over a part of the shape, in its centred frame.
SurfacePoints centred_points(const AlignmentShape& shape, const TriangleMesh& part) {
  SurfacePoints points = spread_points(part, n_points);
  for (Vec3& p : points.points) p = (p - shape.center) / shape.size;
  return points;
}

}  // namespace

AlignmentShape make_alignment_shape(const TriangleMesh& mesh) {
  require_sound_mesh(mesh, "the shape");
  const SurfaceSpread spread = surface_spread(mesh);
  if (!(spread.covariance.trace() > 0.0) || !std::isfinite(spread.covariance.trace()))
    fail("the shape has no surface area, expected triangles that are not degenerate");
  AlignmentShape shape;
  shape.bvh = MeshBvh(mesh);
  shape.center = spread.center;
  shape.size = std::sqrt(spread.covariance.trace());
  set_axes(shape, spread.covariance / spread.covariance.trace() * (shape.size * shape.size));
  SurfacePoints points = centred_points(shape, mesh);
  shape.points = std::move(points.points);
  shape.normals = std::move(points.normals);
  return shape;
}

AlignmentShape make_alignment_shape(const TriangleMesh& mesh, const TriangleMesh& seen) {
  AlignmentShape shape = make_alignment_shape(mesh);
  shape.seen = centred_points(shape, seen).points;
  return shape;
}

Alignment inverse(const Alignment& alignment) {
  Alignment back = alignment;
  back.R = alignment.R.transpose();
  std::swap(back.center_model, back.center_target);
  back.scale = 1.0 / alignment.scale;
  return back;
}

}  // namespace eigengrasp
