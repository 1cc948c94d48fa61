// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Approximate radius against closed forms, and the rule of graspable sizes.
#include <gtest/gtest.h>

#include "eigengrasp/database/graspable_size.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

Box box_of(const Vec3& size) {
  Box box;
  box.add(Vec3::Zero());
  box.add(size);
  return box;
}

TEST(GraspableSize, the_radius_of_a_square_is_that_of_the_closed_form) {
  TriangleMesh square;  // of side 2 about the origin
  square.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const double mean = (std::sqrt(2.0) + std::log(1.0 + std::sqrt(2.0))) / 3.0;  // of the distance
  const double deviation = std::sqrt(2.0 / 3.0 - mean * mean);                  // the mean square is 2/3
  EXPECT_NEAR(approximate_radius(square, Vec3::Zero()), mean + 2.0 * deviation, 1e-3 * mean);
  for (Vec3& v : square.vertices) v *= 0.01;
  EXPECT_NEAR(approximate_radius(square, Vec3::Zero()), 0.01 * (mean + 2.0 * deviation), 1e-5 * mean);
}

TEST(GraspableSize, the_middle_side_becomes_70_mm_but_the_longest_no_more_than_250) {
  EXPECT_DOUBLE_EQ(graspable_rescale(box_of({1.0, 0.7, 0.1})), 0.1);
  EXPECT_DOUBLE_EQ(graspable_rescale(box_of({0.1, 2.5, 0.1})), 0.1);
  EXPECT_DOUBLE_EQ(graspable_rescale(box_of({0.0, 0.0, 0.5})), 0.5);
  EXPECT_TRUE(is_graspable(box_of({0.08, 0.08, 0.15})));
  EXPECT_FALSE(is_graspable(box_of({0.2, 0.2, 0.2})));
  EXPECT_FALSE(is_graspable(box_of({0.08, 0.08, 0.6})));
  EXPECT_FALSE(is_graspable(box_of({0.008, 0.008, 0.02})));
}

}  // namespace
}  // namespace eigengrasp
