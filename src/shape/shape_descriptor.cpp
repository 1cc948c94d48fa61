// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/shape/shape_descriptor.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "shape/grid_moments.hpp"
#include "shape/surface_points.hpp"

namespace eigengrasp {

namespace {

constexpr double surface_width = 0.14;  // of the radius
constexpr double sizes_a_radius = 2.0;
constexpr double farthest_share = 0.9;  // of the radius, for solids: the grid has no cells at the very rim

/// Refuses what has no area, or all in a plane where that is not allowed.
void require_spread(const SurfaceSpread& spread, bool allow_flat) {
  const double total = spread.covariance.trace();
  if (!std::isfinite(total) || !(total > 0.0))
    fail("the shape has no surface area, expected triangles that are not degenerate");
  if (allow_flat) return;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(spread.covariance / total, Eigen::EigenvaluesOnly);
  constexpr double flat = 1e-12;  // of the variance
  if (solver.eigenvalues()[0] < flat)
    fail("the shape lies in a plane, expected one with extent in all directions");
}

ShapeDescriptor describe_surface(const TriangleMesh& mesh, const SurfaceSpread& spread) {
  ShapeDescriptor d;
  d.ball = {spread.center, sizes_a_radius * std::sqrt(spread.covariance.trace())};
  d.invariants = compute_thick_surface_moments(mesh, d.ball, surface_width, kDescriptorOrder).invariants();
  return d;
}

double farthest_vertex(const TriangleMesh& mesh, const Vec3& center) {
  double radius = 0.0;
  for (const auto& triangle : mesh.triangles)
    for (const std::int32_t v : triangle)
      radius = std::max(radius, (mesh.vertices[static_cast<std::size_t>(v)] - center).norm());
  return radius;
}

ShapeDescriptor describe_solid(const TriangleMesh& mesh, const DescriptorOptions& options) {
  ShapeDescriptor d;
  const MeshReport report = inspect_mesh(mesh);
  d.route = report.solid() && options.closed_by_moments ? DescriptorRoute::moments : DescriptorRoute::voxels;
  d.ball.center = report.center_of_mass();
  d.ball.radius = farthest_vertex(mesh, d.ball.center) / farthest_share;
  d.invariants =
      (d.route == DescriptorRoute::moments ? compute_solid_moments(mesh, d.ball, kDescriptorOrder)
                                           : compute_filled_moments(mesh, d.ball, kDescriptorOrder))
          .invariants();
  constexpr double nothing = 1e-6;  // of the ball
  if (d.invariants.front() < nothing)
    fail("the shape encloses no space; describe it by its surface (function \"surface\")");
  return d;
}

}  // namespace

const char* to_string(ShapeFunction function) {
  return function == ShapeFunction::surface ? "surface" : "solid";
}

const char* to_string(DescriptorRoute route) {
  return route == DescriptorRoute::moments ? "moments" : "voxels";
}

ShapeFunction parse_shape_function(const std::string& name) {
  for (const ShapeFunction function : {ShapeFunction::surface, ShapeFunction::solid})
    if (name == to_string(function)) return function;
  fail("there is no function of a shape '{}', expected surface or solid", name);
}

ShapeDescriptor compute_shape_descriptor(const TriangleMesh& mesh, const DescriptorOptions& options) {
  require_sound_mesh(mesh, "the shape");
  const SurfaceSpread spread = surface_spread(mesh);
  require_spread(spread, options.allow_flat);
  ShapeDescriptor d = options.function == ShapeFunction::surface ? describe_surface(mesh, spread)
                                                                 : describe_solid(mesh, options);
  return make_shape_descriptor(std::move(d.invariants), options.function, d.route, d.ball);
}

ShapeDescriptor make_shape_descriptor(std::vector<double> invariants, ShapeFunction function,
                                      DescriptorRoute route, const ShapeBall& ball) {
  if (invariants.size() != kDescriptorSize)
    fail("a shape descriptor has {} invariants, expected {}", invariants.size(), kDescriptorSize);
  const std::vector<double>& weights = descriptor_weights();
  double sum = 0.0;
  for (std::size_t i = 0; i < kDescriptorSize; ++i) {
    if (!(invariants[i] >= 0.0))
      fail("a shape descriptor has the invariant {}, expected 0 or more", invariants[i]);
    sum += std::pow(weights[i] * invariants[i], 2);
  }
  if (!std::isfinite(sum) || !(sum > 0.0))
    fail("a shape descriptor has invariants that are not finite, or all 0");
  ShapeDescriptor d;
  d.function = function;
  d.route = route;
  d.ball = ball;
  for (std::size_t i = 0; i < kDescriptorSize; ++i)
    d.values.push_back(static_cast<float>(weights[i] * invariants[i] / std::sqrt(sum)));
  d.invariants = std::move(invariants);
  return d;
}

double descriptor_distance(const ShapeDescriptor& a, const ShapeDescriptor& b) {
  if (a.function != b.function)
    fail("a descriptor of the {} and one of the {} cannot be compared", to_string(a.function),
         to_string(b.function));
  double sum = 0.0;
  for (std::size_t i = 0; i < a.values.size() && i < b.values.size(); ++i)
    sum += std::pow(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i]), 2);
  return std::sqrt(sum);
}

}  // namespace eigengrasp
