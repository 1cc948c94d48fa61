// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Free times of moving surfaces against exact distances along the motion and closed forms.
#include "eigengrasp/geometry/mesh_motion.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/gripper.hpp"
#include "support/moving_chain.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp {
namespace {

using testing::any_chain;
using testing::any_point;
using testing::any_pose;
using testing::ball_mesh;
using testing::box_mesh;
using testing::Chain;
using testing::torus_mesh;
using testing::turned_about;

constexpr double margin = 0.00005;

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

/// Two surfaces on chains of which the outer joints stop on the way.
struct MovingPair {
  Chain of_a;
  Chain of_b;
  Pose X_start;
  double stop_a;  ///< [s]
  double stop_b;

  Pose a_at(double t) const { return of_a.at(t, std::min(t, stop_a)); }
  Pose b_at(double t) const { return of_b.at(t, std::min(t, stop_b)) * X_start; }
  Pose at(double t) const { return a_at(t).inverse() * b_at(t); }

  /// Joints that move at time t, in the frame of a.
  std::vector<Screw> screws(const Chain& chain, double t, double stop) const {
    const Pose X_AO = a_at(t).inverse();
    std::vector<Screw> result;
    for (int j = 0; j < (t < stop ? 2 : 1); ++j) {
      const Pose X = j == 0 ? X_AO : X_AO * turned_about(chain.axes[0], chain.points[0], chain.rates[0] * t);
      const Vec3 w = chain.rates[j] * (X.linear() * chain.axes[j]);
      result.push_back({w, (X * chain.points[j]).cross(w)});
    }
    return result;
  }
};

using TrianglePairs = std::map<std::pair<int, int>, double>;

/// The front finds the same pairs of triangles as a search from the roots.
void expect_same_pairs(const SeparationFront& front, const MeshBvh& a, const MeshBvh& b, const Pose& X_AB,
                       const DistanceField& field) {
  constexpr double reach = 0.004;
  TrianglePairs found, expected;
  const auto add_to = [](TrianglePairs& pairs) {
    return [&pairs](const ClosestPair& p) {
      EXPECT_TRUE(pairs.emplace(std::pair(p.triangle_a, p.triangle_b), p.distance).second) << "twice";
    };
  };
  front.for_each_pair_within(a, b, X_AB, reach, field, add_to(found));
  for_each_pair_within(a, b, X_AB, reach, add_to(expected));
  EXPECT_EQ(found, expected);
}

/// Looks until time `end` or until the two nearly touch; the distances on the way are exact ones.
void follow(const MeshBvh& a, const MeshBvh& b, const MovingPair& pair, const DistanceField& field,
            double end, int& touches) {
  SeparationFront front;
  const double acceleration =
      (field.empty() ? pair.of_a.acceleration(0.5) : 0.0) + pair.of_b.acceleration(0.5);
  double t = 0.0;
  for (int looks = 0; t < end; ++looks) {
    ASSERT_LT(looks, 500);
    const double before = closest_pair(a, b, pair.at(t)).distance;
    const auto screws_a = field.empty() ? pair.screws(pair.of_a, t, pair.stop_a) : std::vector<Screw>{};
    const auto screws_b = pair.screws(pair.of_b, t, pair.stop_b);
    const FreeTime free =
        front.look(a, b, pair.at(t), {screws_a, screws_b, acceleration}, t, margin, 0.1, field);
    ASSERT_GT(free.time, 0.0);
    ASSERT_GE(front.free_until(), t + free.time);
    ASSERT_GT(front.clearance(), 0.0);
    if (looks % 4 == 0) expect_same_pairs(front, a, b, pair.at(t), field);
    if (free.distance <= 2.0 * margin) {
      EXPECT_LE(before, 2.0 * margin);
      ++touches;
      return;
    }
    const double until = std::min(front.free_until(), end);
    for (const double share : {0.3, 0.7, 0.95, 1.0}) {
      const double distance = closest_pair(a, b, pair.at(t + share * (until - t))).distance;
      ASSERT_GE(distance, std::min(margin, 0.5 * before) - 1e-9);
      ASSERT_GE(distance, front.clearance() - 1e-12);
    }
    t = looks % 3 == 2 ? 0.5 * (t + until) : until;  // to look earlier is allowed
  }
}

TEST(SeparationFront, NothingComesNearerThanTheMarginFromLookToLookVsExactDistances) {
  RandomStream random{8};
  const MeshBvh torus(torus_mesh(0.03, 0.01, 24));
  const MeshBvh box(box_mesh({0.05, 0.02, 0.08}));
  const DistanceField field(torus);
  int touches = 0;
  for (int i = 0; i < 200; ++i) {
    const bool with_field = i % 3 == 0;
    const MeshBvh& a = with_field || i % 2 == 0 ? torus : box;
    const MeshBvh b(i % 4 < 2 ? ball_mesh(0.02, 10) : box_mesh({0.02, 0.03, 0.01}));
    MovingPair pair{any_chain(random, a.box()), any_chain(random, a.box()), any_pose(random, 0.07),
                    random.uniform(0.0, 3.0), random.uniform(0.0, 3.0)};
    if (with_field) pair.of_a.rates[0] = pair.of_a.rates[1] = 0.0;  // only what rests has a field
    if (closest_pair(a, b, pair.X_start).distance == 0.0) continue;
    follow(a, b, pair, with_field ? field : DistanceField{}, 3.0, touches);
    if (HasFatalFailure()) FAIL() << i;
  }
  EXPECT_GT(touches, 20);
}

TEST(SeparationFront, SeesSurfacesThatCross) {
  const MeshBvh a(box_mesh({0.05, 0.02, 0.08}));
  const MeshBvh b(ball_mesh(0.02, 10));
  const FreeTime free =
      SeparationFront().look(a, b, Pose(Eigen::Translation3d(0.03, 0.0, 0.0)), {}, 0.0, margin, 1.0);
  EXPECT_EQ(free.time, 0.0);
  EXPECT_EQ(free.distance, 0.0);
}

TEST(SeparationFront, FindsNearPairsBeforeTheFirstLookAndInAnyPose) {
  RandomStream random{9};
  const MeshBvh a(torus_mesh(0.03, 0.01, 24));
  const MeshBvh b(ball_mesh(0.02, 10));
  const DistanceField field(a);
  SeparationFront front;
  for (int i = 0; i < 100; ++i) {
    const Pose X_AB = any_pose(random, 0.05);
    expect_same_pairs(SeparationFront(), a, b, X_AB, i % 2 == 0 ? field : DistanceField());
    expect_same_pairs(front, a, b, X_AB, field);
    if (i == 0) front.look(a, b, X_AB, {}, 0.0, margin, 1.0, field);
  }
}

TEST(SeparationFront, HasNoClearanceAfterACrossing) {
  const MeshBvh a(box_mesh({0.05, 0.02, 0.08}));
  const MeshBvh b(ball_mesh(0.02, 10));
  SeparationFront front;
  EXPECT_EQ(front.clearance(), 0.0);
  front.look(a, b, Pose(Eigen::Translation3d(0.03, 0.0, 0.0)), {}, 0.0, margin, 1.0);
  EXPECT_EQ(front.clearance(), 0.0);
}

TEST(Intersects, IsTheSameWithAField) {
  RandomStream random{10};
  const MeshBvh a(torus_mesh(0.03, 0.01, 24));
  const MeshBvh b(testing::capsule_mesh(0.008, 0.03));
  const DistanceField field(a);
  int crossing = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose X_AB = any_pose(random, 0.06);
    const bool expected = intersects(a, b, X_AB);
    EXPECT_EQ(intersects(a, b, X_AB, field), expected) << i;
    EXPECT_EQ(intersects(a, b, X_AB, DistanceField()), expected) << i;
    crossing += expected;
  }
  EXPECT_GT(crossing, 50);
  EXPECT_LT(crossing, 450);
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
