// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Distance of two triangles against dense samples of both, degenerate ones included.
#include <gtest/gtest.h>

#include <algorithm>

#include "eigengrasp/geometry/triangle_queries.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using testing::random_direction;

TriangleCorners random_triangle(RandomStream& random, double reach) {
  return {reach * random_direction(random), reach * random_direction(random),
          reach * random_direction(random)};
}

/// Triangles as they come: with area, as a segment, as a point, thin as a needle.
TriangleCorners any_triangle(RandomStream& random) {
  TriangleCorners t = random_triangle(random, 1.0);
  const double kind = random.uniform();
  if (kind < 0.15) t.c = t.a + random.uniform() * (t.b - t.a);
  if (kind < 0.1) t.c = t.b;
  if (kind < 0.05) t.b = t.c = t.a;
  if (kind > 0.9) t.c = t.a + 0.3 * (t.b - t.a) + 1e-7 * t.c;
  return t;
}

TriangleCorners shifted(const TriangleCorners& t, const Vec3& d) {
  return {t.a + d, t.b + d, t.c + d};
}

/// Upper bound of the distance of two triangles, from points of s on a grid; at most one grid step too high.
double sampled_distance(const TriangleCorners& s, const TriangleCorners& t, int n) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const Vec3 p = s.a + (s.b - s.a) * i / n + (s.c - s.a) * j / n;
      nearest = std::min(nearest, (closest_point_on_triangle(t, p) - p).norm());
    }
  return nearest;
}

double longest_side(const TriangleCorners& t) {
  return std::max({(t.a - t.b).norm(), (t.b - t.c).norm(), (t.c - t.a).norm()});
}

double distance_to(const TriangleCorners& t, const Vec3& p) {
  return (closest_point_on_triangle(t, p) - p).norm();
}

TEST(TriangleQueries, ClosestPointVsDenseSamples) {
  RandomStream random{1};
  for (int i = 0; i < 300; ++i) {
    const TriangleCorners t = any_triangle(random);
    const Vec3 p = 2.0 * random.uniform() * random_direction(random);
    const double d = distance_to(t, p);
    const double sampled = sampled_distance(t, {p, p, p}, 60);
    EXPECT_LE(d, sampled + 1e-7);
    EXPECT_GE(d, sampled - longest_side(t) / 60.0 - 1e-7);
    EXPECT_LT(distance_to(t, closest_point_on_triangle(t, p)), 1e-9);
  }
}

TEST(TriangleQueries, DistanceVsDenseSamples) {
  RandomStream random{2};
  int crossing = 0;
  for (int i = 0; i < 400; ++i) {
    const TriangleCorners s = any_triangle(random);
    const TriangleCorners t =
        shifted(any_triangle(random), 2.0 * random.uniform() * random_direction(random));
    Vec3 p, q;
    const double d = closest_points_of_triangles(s, t, p, q);
    const double sampled = sampled_distance(s, t, 40);
    EXPECT_LE(d, sampled + 1e-7);
    EXPECT_GE(d, sampled - longest_side(s) / 40.0 - 1e-7);
    EXPECT_LT(distance_to(s, p), 1e-9);
    EXPECT_LT(distance_to(t, q), 1e-9);
    EXPECT_NEAR((p - q).norm(), d, 1e-9);
    Vec3 p2, q2;
    EXPECT_NEAR(closest_points_of_triangles(t, s, q2, p2), d, 1e-9);
    crossing += d == 0.0;
  }
  EXPECT_GT(crossing, 20);
}

TEST(TriangleQueries, PlaneSeparatesNeverContradictsTheDistance) {
  RandomStream random{3};
  int separated = 0;
  for (int i = 0; i < 20000; ++i) {
    const TriangleCorners s = any_triangle(random);
    const TriangleCorners t =
        shifted(any_triangle(random), 2.5 * random.uniform() * random_direction(random));
    const double bound = random.uniform() < 0.3 ? 0.0 : random.uniform();
    if (!plane_separates(s, t, bound)) continue;
    ++separated;
    Vec3 p, q;
    EXPECT_GT(closest_points_of_triangles(s, t, p, q), bound - 1e-7);
    EXPECT_FALSE(triangles_cross(s, t));
  }
  EXPECT_GT(separated, 2000);
}

TEST(TriangleQueries, SegmentsOfAnyKind) {
  RandomStream random{4};
  for (int i = 0; i < 300; ++i) {
    const Vec3 p0 = random_direction(random), q0 = random_direction(random);
    const Vec3 p1 = i % 5 == 0 ? p0 : random_direction(random);
    // Parallel ones and points among them.
    const Vec3 q1 = i % 7 == 0 ? q0 : i % 3 == 0 ? Vec3(q0 + 0.7 * (p1 - p0)) : random_direction(random);
    Vec3 p, q;
    const double d = closest_points_of_segments(p0, p1, q0, q1, p, q);
    EXPECT_NEAR((p - q).norm(), d, 1e-12);
    double sampled = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 200; ++k)
      sampled = std::min(sampled, distance_to({q0, q1, q1}, p0 + k / 200.0 * (p1 - p0)));
    EXPECT_LE(d, sampled + 1e-9);
    EXPECT_GE(d, sampled - (p1 - p0).norm() / 200.0 - 1e-9);
  }
}

TEST(TriangleQueries, SegmentThroughATriangle) {
  const TriangleCorners t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Vec3 hit;
  ASSERT_TRUE(segment_hits_triangle({0.2, 0.3, 1.0}, {0.2, 0.3, -1.0}, t, hit));
  EXPECT_LT((hit - Vec3(0.2, 0.3, 0.0)).norm(), 1e-12);
  EXPECT_FALSE(segment_hits_triangle({0.2, 0.3, 1.0}, {0.2, 0.3, 0.1}, t, hit));
  EXPECT_FALSE(segment_hits_triangle({0.7, 0.7, 1.0}, {0.7, 0.7, -1.0}, t, hit));
  EXPECT_FALSE(segment_hits_triangle({-1.0, 0.2, 0.0}, {2.0, 0.2, 0.0}, t, hit)) << "in its plane";
}

TEST(TriangleQueries, ACoplanarOverlapHasDistanceZero) {
  const TriangleCorners t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Vec3 p, q;
  EXPECT_NEAR(closest_points_of_triangles(t, shifted(t, {0.2, 0.2, 0.0}), p, q), 0.0, 1e-12);
  EXPECT_NEAR(closest_points_of_triangles(t, shifted(t, {0.2, 0.2, 0.5}), p, q), 0.5, 1e-12);
}

}  // namespace
}  // namespace eigengrasp
