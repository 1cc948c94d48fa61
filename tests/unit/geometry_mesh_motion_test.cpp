// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Free times of moving surfaces against exact distances along the motion and closed forms.
#include "eigengrasp/geometry/mesh_motion.hpp"

#include <gtest/gtest.h>

#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using testing::any_point;
using testing::any_pose;
using testing::ball_mesh;
using testing::box_mesh;
using testing::random_direction;
using testing::torus_mesh;

constexpr double margin = 0.00005;

Pose turned_about(const Vec3& axis, const Vec3& through, double angle) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  X.translation() = through - X.linear() * through;
  return X;
}

/// A chain of two joints that moves a surface: the outer one is carried along by the inner one.
struct Chain {
  Vec3 axes[2];
  Vec3 points[2];
  double rates[2];

  Pose at(double t, double t_outer) const {
    return turned_about(axes[0], points[0], rates[0] * t) *
           turned_about(axes[1], points[1], rates[1] * t_outer);
  }
  std::vector<Screw> screws() const {
    std::vector<Screw> result;
    for (int j = 0; j < 2; ++j) {
      const Vec3 w = rates[j] * axes[j];
      result.push_back({w, points[j].cross(w)});
    }
    return result;
  }
  /// Bound for points within `reach` of both joints.
  double acceleration(double reach) const {
    const double a = std::abs(rates[0]);
    const double b = std::abs(rates[1]);
    return reach * (a * a + b * (b + 2.0 * a));
  }
};

Chain any_chain(RandomStream& random, const Box& box) {
  Chain chain;
  for (int j = 0; j < 2; ++j) {
    chain.axes[j] = random_direction(random);
    chain.points[j] = any_point(random, box, 0.05);
    chain.rates[j] = random.uniform(-1.0, 1.0);
  }
  return chain;
}

TEST(FreeTime, NothingComesNearerThanTheMarginVsExactDistances) {
  RandomStream random{5};
  int limited = 0;
  for (int i = 0; i < 150; ++i) {
    const MeshBvh a(i % 2 == 0 ? torus_mesh(0.03, 0.01, 24) : box_mesh({0.05, 0.02, 0.08}));
    const MeshBvh b(i % 3 == 0 ? ball_mesh(0.02, 10) : box_mesh({0.02, 0.03, 0.01}));
    const Pose X_AB = any_pose(random, 0.07);
    const double before = closest_pair(a, b, X_AB).distance;
    const Chain of_a = any_chain(random, a.box());
    const Chain of_b = any_chain(random, a.box());
    const auto screws_a = of_a.screws();
    const auto screws_b = of_b.screws();
    const SurfaceMotion motion{screws_a, screws_b, of_a.acceleration(0.5) + of_b.acceleration(0.5)};
    PairHint hint;
    const FreeTime free = compute_free_time(a, b, X_AB, motion, margin, 0.3, &hint);
    if (before == 0.0) {
      EXPECT_EQ(free.time, 0.0) << i;
      EXPECT_EQ(free.distance, 0.0) << i;
      continue;
    }
    EXPECT_GT(free.time, 0.0) << i;
    EXPECT_NEAR(compute_free_time(a, b, X_AB, motion, margin, 0.3, &hint).time, free.time, 1e-12) << i;
    limited += free.time < 0.3;
    for (const double share : {0.2, 0.5, 0.8, 1.0})
      for (const double outer : {0.0, 0.5, 1.0}) {  // the outer joints may stop on the way
        const double t = share * free.time;
        const Pose X = of_a.at(t, outer * t).inverse() * of_b.at(t, outer * t) * X_AB;
        EXPECT_GE(closest_pair(a, b, X).distance, std::min(margin, 0.5 * before) - 1e-9) << i;
      }
  }
  EXPECT_GT(limited, 50);
}

TEST(FreeTime, RoughTimesAreFreeToo) {
  RandomStream random{6};
  const MeshBvh a(torus_mesh(0.03, 0.01, 24));
  const DistanceField field(a);
  const MeshBvh b(box_mesh({0.02, 0.03, 0.01}));
  int positive = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X_AB = any_pose(random, 0.12);
    const Chain of_b = any_chain(random, a.box());
    const auto screws = of_b.screws();
    const SurfaceMotion motion{{}, screws, of_b.acceleration(0.5)};
    const double time = compute_rough_free_time(field, b, X_AB, motion, margin, 0.3);
    positive += time > 0.0;
    const FreeTime with_field = compute_free_time(a, b, X_AB, motion, margin, 0.3, nullptr, field);
    EXPECT_NEAR(with_field.time, compute_free_time(a, b, X_AB, motion, margin, 0.3).time, 1e-12) << i;
    if (time == 0.0) continue;
    for (const double t : {0.5 * time, time})
      EXPECT_GE(closest_pair(a, b, of_b.at(t, t) * X_AB).distance, margin - 1e-9) << i;
  }
  EXPECT_GT(positive, 50);
}

TEST(FreeTime, RoughTimesOfTwoMovingSurfacesAreFreeToo) {
  RandomStream random{8};
  const MeshBvh a(torus_mesh(0.03, 0.01, 24));
  const MeshBvh b(box_mesh({0.02, 0.03, 0.01}));
  int positive = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X_AB = any_pose(random, 0.12);
    const Chain of_a = any_chain(random, a.box());
    const Chain of_b = any_chain(random, a.box());
    const auto screws_a = of_a.screws();
    const auto screws_b = of_b.screws();
    const SurfaceMotion motion{screws_a, screws_b, of_a.acceleration(0.5) + of_b.acceleration(0.5)};
    const double time =
        std::min(1.0, compute_rough_free_time(a, Pose::Identity(), b, X_AB, motion, margin, 0.3));
    positive += time > 0.0;
    if (time == 0.0) continue;
    for (const double t : {0.5 * time, time})
      for (const double outer : {0.0, 1.0}) {
        const Pose X = of_a.at(t, outer * t).inverse() * of_b.at(t, outer * t) * X_AB;
        EXPECT_GE(closest_pair(a, b, X).distance, margin - 1e-7) << i;
      }
  }
  EXPECT_GT(positive, 50);
}

TEST(FreeTime, CertainDistancesAreLowerBounds) {
  RandomStream random{7};
  const MeshBvh bvh(torus_mesh(0.03, 0.01, 24));
  const DistanceField field(bvh);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = any_point(random, bvh.box(), i % 2 == 0 ? 0.02 : 0.5);
    EXPECT_LE(certain_distance(field, p), bvh.closest_point(p).distance) << i;
    const Vec3 larger = 1.5 * p;
    EXPECT_LE(certain_distance(field.scaled(1.5), larger), 1.5 * bvh.closest_point(p).distance) << i;
  }
}

// A box of half height 5 mm that sinks towards another one, or slides over it.
TEST(FreeTime, OfABoxOverABox) {
  const MeshBvh table(box_mesh({0.1, 0.1, 0.01}));
  const MeshBvh box(box_mesh({0.01, 0.01, 0.01}));
  Pose X = Pose::Identity();
  X.translation().z() = 0.013;  // a gap of 3 mm
  const Screw down{Vec3::Zero(), Vec3(0.0, 0.0, -0.1)};
  const Screw aside{Vec3::Zero(), Vec3(0.1, 0.0, 0.0)};
  const auto time = [&](const Screw& screw, double acceleration) {
    return compute_free_time(table, box, X, {{}, {&screw, 1}, acceleration}, margin, 1.0).time;
  };
  EXPECT_NEAR(time(down, 0.0), (0.003 - margin) / 0.1, 1e-9);
  EXPECT_NEAR(time(aside, 0.0), 1.0, 1e-12) << "slides for ever";
  EXPECT_NEAR(time(aside, 0.2), std::sqrt(2.0 * (0.003 - margin) / 0.2), 1e-9);
}

TEST(FreeTime, TimeToCloseVsItsEquation) {
  EXPECT_EQ(time_to_close(0.0, 1.0, 1.0), 0.0);
  EXPECT_EQ(time_to_close(1.0, 0.0, 0.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(time_to_close(1.0, -1.0, 0.0), std::numeric_limits<double>::infinity());
  for (const double rate : {-2.0, 0.0, 3.0}) {
    const double t = time_to_close(0.7, rate, 0.4);
    EXPECT_NEAR(rate * t + 0.2 * t * t, 0.7, 1e-12);
  }
}

}  // namespace
}  // namespace eigengrasp
