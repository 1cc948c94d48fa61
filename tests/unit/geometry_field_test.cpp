// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The distance field against exact signed distances of the mesh it was made from.
#include "eigengrasp/geometry/distance_field.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using testing::any_point;

struct Shape {
  Shape(const char* shape_name, const TriangleMesh& mesh) : name(shape_name), bvh(mesh), field(bvh) {}
  const char* name;
  MeshBvh bvh;
  DistanceField field;
};

const Shape& ball() {
  static const Shape shape("ball", testing::ball_mesh(0.03, 32));
  return shape;
}

const Shape& box() {
  static const Shape shape("box", testing::box_mesh({0.03, 0.05, 0.08}));
  return shape;
}

std::vector<const Shape*> shapes() {
  static const Shape cup("cup", testing::cup_mesh(0.03, 0.07, 0.0006));
  static const Shape torus("torus", testing::torus_mesh(0.04, 0.012, 32));
  return {&ball(), &box(), &cup, &torus};
}

Vec3 node(const FieldGrid& grid, int x, int y, int z) {
  return grid.origin + grid.cell * Vec3(x, y, z);
}

TEST(DistanceField, IsExactAtTheNodes) {
  RandomStream random{1};
  for (const Shape* shape : shapes()) {
    const DistanceField& field = shape->field;
    for (const FieldGrid* grid : {&field.fine(), &field.coarse()})
      for (int i = 0; i < 400; ++i) {
        const Vec3 u(random.uniform(), random.uniform(), random.uniform());
        const Eigen::Vector3i n = (u.array() * grid->nodes.cast<double>().array()).cast<int>();
        const Vec3 p = node(*grid, n.x(), n.y(), n.z());
        EXPECT_NEAR(grid->value(p), shape->bvh.signed_distance(p), 1e-6)
            << shape->name << " " << p.transpose();
      }
  }
}

TEST(DistanceField, IsNowhereOffByMoreThanHalfACell) {
  RandomStream random{2};
  for (const Shape* shape : shapes()) {
    const DistanceField& field = shape->field;
    const double cell = field.fine().cell;
    double largest = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 p = any_point(random, shape->bvh.box(), 0.015);
      ASSERT_TRUE(field.fine().contains(p));
      largest = std::max(largest, std::abs(field.distance(p) - shape->bvh.signed_distance(p)));
    }
    std::cout << shape->name << ": cell " << 1e3 * cell << " mm, largest error " << 1e3 * largest << " mm\n";
    EXPECT_LT(largest, 0.5 * cell) << shape->name;
  }
}

// Away from the medial axis the field bends as the distance does: the error is that of linear interpolation.
TEST(DistanceField, IsOffByTheBendOfTheDistanceAwayFromTheMedialAxis) {
  RandomStream random{3};
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = any_point(random, ball().bvh.box(), 0.015);
    const double r = p.norm();
    const double cell = ball().field.fine().cell;
    // Curved in two directions; the facets of the ball deviate from it by 0.04 mm.
    if (r > 0.010) {
      EXPECT_NEAR(ball().field.distance(p), r - 0.03, cell * cell / (4.0 * (r - cell)) + 8e-5);
    }
    const Vec3 q = any_point(random, box().bvh.box(), 0.015);
    const double d = box().bvh.signed_distance(q);
    const double c = box().field.fine().cell;
    if (d > 2.0 * c) {
      EXPECT_NEAR(box().field.distance(q), d, c * c / (4.0 * (d - c)) + 1e-6);
    }
  }
}

TEST(DistanceField, GradientIsThatOfTheValue) {
  RandomStream random{4};
  for (const Shape* shape : shapes()) {
    const DistanceField& field = shape->field;
    for (const double margin : {0.015, 0.2}) {
      for (int i = 0; i < 500; ++i) {
        const Vec3 p = any_point(random, shape->bvh.box(), margin);
        const FieldGrid& grid = field.fine().contains(p) ? field.fine() : field.coarse();
        // Inside one cell, so that the difference does not straddle a kink.
        const double h = 1e-3 * grid.cell;
        const Vec3 u = (p - grid.origin) / grid.cell;
        const Vec3 place = u - u.array().floor().matrix();
        if (place.minCoeff() < 0.01 || place.maxCoeff() > 0.99) continue;
        Vec3 difference;
        for (Eigen::Index k = 0; k < 3; ++k)
          difference[k] =
              (field.distance(p + h * Vec3::Unit(k)) - field.distance(p - h * Vec3::Unit(k))) / (2.0 * h);
        const FieldSample s = field.sample(p);
        EXPECT_LT((s.gradient - difference).norm(), 1e-6) << shape->name;
        EXPECT_EQ(s.distance, field.distance(p));
      }
    }
  }
}

TEST(DistanceField, GradientPointsAwayFromABall) {
  RandomStream random{5};
  const DistanceField& field = ball().field;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random.uniform(0.01, 0.25) * testing::random_direction(random);
    const Vec3 g = field.sample(p).gradient;
    EXPECT_NEAR(g.norm(), 1.0, 0.1);  // facets and cells
    EXPECT_GT(g.normalized().dot(p.normalized()), 0.995);
  }
}

TEST(DistanceField, OutsideBothGridsTheDistanceGoesOn) {
  RandomStream random{6};
  for (const Shape* shape : shapes()) {
    const DistanceField& field = shape->field;
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = random.uniform(0.6, 3.0) * testing::random_direction(random);
      ASSERT_FALSE(field.coarse().contains(p));
      const double exact = shape->bvh.signed_distance(p);
      const FieldSample s = field.sample(p);
      EXPECT_NEAR(s.distance, exact, 0.02 * exact) << shape->name;
      EXPECT_EQ(s.distance, field.distance(p));
      const Vec3 away = (p - shape->bvh.closest_point(p).point).normalized();
      EXPECT_GT(s.gradient.dot(away), 0.99) << shape->name;
    }
  }
}

TEST(DistanceField, ThreadsDoNotChangeIt) {
  const MeshBvh bvh(testing::torus_mesh(0.04, 0.012, 24));
  DistanceFieldOptions options;
  options.far_margin = 0.1;
  options.threads = 1;
  const DistanceField one(bvh, options);
  options.threads = 2;
  const DistanceField two(bvh, options);
  EXPECT_EQ(one.fine().values, two.fine().values);
  EXPECT_EQ(one.coarse().values, two.coarse().values);
  EXPECT_TRUE(DistanceField(MeshBvh()).empty());
}

}  // namespace
}  // namespace eigengrasp
