// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Descriptors against the laws they must keep, the grid against exact moments, and bad input.
#include "eigengrasp/shape/shape_descriptor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "eigengrasp/core/error.hpp"
#include "support/solid_shapes.hpp"
#include "unit/shape_test_shapes.hpp"

namespace eigengrasp::testing {
namespace {

DescriptorOptions of(ShapeFunction function, bool by_moments = true) {
  DescriptorOptions options;
  options.function = function;
  options.closed_by_moments = by_moments;
  return options;
}

/// The largest distance from the descriptor of the shape as it is, over random rotations, sizes and places.
double worst_change(const TriangleMesh& mesh, const DescriptorOptions& options, int count) {
  const ShapeDescriptor still = compute_shape_descriptor(mesh, options);
  RandomStream stream{11};
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const double scale = std::pow(10.0, stream.uniform(-3.0, 3.0));
    const Vec3 shift(stream.normal(), stream.normal(), stream.normal());
    const auto d =
        compute_shape_descriptor(moved(mesh, random_rotation(stream), scale, 5.0 * scale * shift), options);
    worst = std::max(worst, descriptor_distance(still, d));
  }
  return worst;
}

TEST(ShapeDescriptor, OfASolidByMomentsStaysUnder100RotationsAndScales) {
  EXPECT_LT(worst_change(box_about({1.0, 0.7, 0.4}, {0.3, 0.0, 0.0}), of(ShapeFunction::solid), 100), 2e-6);
  EXPECT_LT(worst_change(cup_mesh(0.04, 0.1, 0.004, 24), of(ShapeFunction::solid), 20), 2e-6);
}

TEST(ShapeDescriptor, OfASurfaceStaysUnder100RotationsAndScales) {
  EXPECT_LT(worst_change(chiral_shape(), of(ShapeFunction::surface), 100), 3e-3);
  EXPECT_LT(worst_change(cup_mesh(0.04, 0.1, 0.004, 24), of(ShapeFunction::surface), 20), 3e-3);
}

TEST(ShapeDescriptor, OnTheGridVsByMoments) {
  for (const TriangleMesh& mesh :
       {box_about({1.0, 0.7, 0.4}, Vec3::Zero()), torus_mesh(1.0, 0.4), capsule_mesh(0.3, 0.5)}) {
    const auto exact = compute_shape_descriptor(mesh, of(ShapeFunction::solid));
    const auto grid = compute_shape_descriptor(mesh, of(ShapeFunction::solid, false));
    EXPECT_EQ(exact.route, DescriptorRoute::moments);
    EXPECT_EQ(grid.route, DescriptorRoute::voxels);
    EXPECT_LT(descriptor_distance(exact, grid), 0.05);
    for (std::size_t i = 0; i < kDescriptorSize; ++i)
      EXPECT_NEAR(exact.invariants[i], grid.invariants[i], 0.02 * exact.invariants[0]) << i;
  }
}

TEST(ShapeDescriptor, OfASoupOrAHoleIsNearThatOfTheClosedMesh) {
  const TriangleMesh closed = torus_mesh(1.0, 0.4);
  TriangleMesh soup = soup_of(closed);
  RandomStream stream{3};
  std::erase_if(soup.triangles, [&](const auto&) { return stream.uniform() < 0.05; });  // small holes
  const auto solid = compute_shape_descriptor(soup, of(ShapeFunction::solid));
  EXPECT_EQ(solid.route, DescriptorRoute::voxels);
  EXPECT_LT(descriptor_distance(solid, compute_shape_descriptor(closed, of(ShapeFunction::solid))), 0.1);
  EXPECT_LT(descriptor_distance(compute_shape_descriptor(soup), compute_shape_descriptor(closed)), 0.02);
  for (auto& t : soup.triangles)
    if (stream.uniform() < 0.5) std::swap(t[0], t[1]);  // sides do not matter to a surface
  EXPECT_LT(descriptor_distance(compute_shape_descriptor(soup), compute_shape_descriptor(closed)), 0.02);
}

TEST(ShapeDescriptor, TellsShapesApart) {
  const auto cup = compute_shape_descriptor(cup_mesh(0.04, 0.1, 0.004));
  const auto other_cup = compute_shape_descriptor(cup_mesh(0.05, 0.12, 0.004));
  const auto torus = compute_shape_descriptor(torus_mesh(1.0, 0.4));
  EXPECT_LT(3.0 * descriptor_distance(cup, other_cup), descriptor_distance(cup, torus));
}

TEST(ShapeDescriptor, HasTheSizeAndLengthThatAreSaid) {
  const auto d = compute_shape_descriptor(chiral_shape());
  ASSERT_EQ(d.values.size(), kDescriptorSize);
  double sum = 0.0;
  for (const float x : d.values) sum += static_cast<double>(x) * x;
  EXPECT_NEAR(sum, 1.0, 1e-5);
  const auto again = make_shape_descriptor(d.invariants, d.function, d.route, d.ball);
  EXPECT_EQ(again.values, d.values);
}

TEST(ShapeDescriptor, BadShapesAreRefused) {
  EXPECT_THROW(compute_shape_descriptor({}), Error);
  TriangleMesh nan = box_shape();
  nan.vertices[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(compute_shape_descriptor(nan), Error);
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  line.triangles = {{0, 1, 2}};
  EXPECT_THROW(compute_shape_descriptor(line), Error);
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_THROW(compute_shape_descriptor(flat), Error);
  DescriptorOptions allowed;
  allowed.allow_flat = true;
  EXPECT_EQ(compute_shape_descriptor(flat, allowed).values.size(), kDescriptorSize);
  TriangleMesh inside_out = box_shape();
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW(compute_shape_descriptor(inside_out, of(ShapeFunction::solid)), Error);
  EXPECT_THROW(descriptor_distance(compute_shape_descriptor(box_shape()),
                                   compute_shape_descriptor(box_shape(), of(ShapeFunction::solid))),
               Error);
  EXPECT_THROW(make_shape_descriptor({1.0}, ShapeFunction::surface, DescriptorRoute::voxels, {}), Error);
  EXPECT_THROW(parse_shape_function("skin"), Error);
}

}  // namespace
}  // namespace eigengrasp::testing
