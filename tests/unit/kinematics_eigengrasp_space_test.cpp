// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/kinematics/eigengrasp_space.hpp"

namespace eigengrasp {
namespace {

using ::testing::HasSubstr;

VecX random_vector(RandomStream& random, int n) {
  VecX v(n);
  for (double& x : v) x = random.normal();
  return v;
}

EigengraspSpace random_space(RandomStream& random, int n_dof, int n) {
  std::vector<Eigengrasp> directions;
  for (int i = 0; i < n; ++i) directions.push_back({"e", random_vector(random, n_dof), -2.0, 3.0});
  return EigengraspSpace(random_vector(random, n_dof), directions);
}

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(EigengraspSpace, ProjectAfterEmbedIsIdentity) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const int n_dof = 1 + static_cast<int>(random.uniform(0.0, 20.0));
    const int n = static_cast<int>(random.uniform(0.0, n_dof + 1.0));
    const EigengraspSpace space = random_space(random, n_dof, n);
    const VecX a = random_vector(random, n);
    EXPECT_LT((space.project(space.embed(a)) - a).norm(), 1e-12);
    const VecX p = random_vector(random, n_dof);
    const VecX q = space.embed(space.project(p));  // orthogonal: what is left has no part in the space
    EXPECT_LT((space.basis().transpose() * (p - q)).norm(), 1e-12);
  }
}

TEST(EigengraspSpace, BasisIsOrthonormalEvenForNearlyDependentDirections) {
  RandomStream random{7};
  const VecX first = random_vector(random, 12);
  const VecX second = first + 1e-4 * random_vector(random, 12);
  const EigengraspSpace space(VecX::Zero(12), {{"a", 5.0 * first, -4, 4}, {"b", second, -4, 4}});
  EXPECT_LT((space.basis().transpose() * space.basis() - Eigen::Matrix2d::Identity()).norm(), 1e-14);
  EXPECT_LT((space[0].direction - first.normalized()).norm(), 1e-15);
  EXPECT_EQ(space[1].direction, space.basis().col(1));
}

TEST(EigengraspSpace, RefusesBadDirections) {
  const VecX origin = VecX::Zero(3);
  EXPECT_THAT(error_of([&] {
                EigengraspSpace(origin, {{"spread", VecX::Zero(3), -4, 4}});
              }),
              HasSubstr("eigengrasp 1 (\"spread\"): the direction is zero"));
  EXPECT_THAT(error_of([&] {
                EigengraspSpace(origin, {{"", VecX::Ones(2), -4, 4}});
              }),
              HasSubstr("eigengrasp 1: the direction has 2 values, expected 3"));
  EXPECT_THAT(error_of([&] {
                EigengraspSpace(origin, {{"a", VecX::Ones(3), -4, 4}, {"b", -VecX::Ones(3), -4, 4}});
              }),
              HasSubstr("eigengrasp 2 (\"b\"): the direction is a combination of the earlier ones"));
  EXPECT_THAT(
      error_of([&] {
        EigengraspSpace(origin, {{"a", VecX::Constant(3, std::numeric_limits<double>::quiet_NaN()), -4, 4}});
      }),
      HasSubstr("not a number"));
}

TEST(EigengraspSpace, IdentitySpansTheLimits) {
  const VecX origin = (VecX(2) << 0.5, -0.5).finished();
  const VecX low = (VecX(2) << -1.0, -2.0).finished();
  const VecX high = (VecX(2) << 1.0, 2.0).finished();
  const auto space = EigengraspSpace::identity(origin, low, high, {"a", "b"});
  ASSERT_EQ(space.size(), 2);
  EXPECT_EQ(space[1].name, "b");
  EXPECT_DOUBLE_EQ(space[0].min, -1.5);
  EXPECT_DOUBLE_EQ(space[0].max, 0.5);
  EXPECT_EQ(space.embed((VecX(2) << space[0].max, space[1].max).finished()), high);
}

TEST(EigengraspSpace, WithSizeCompletesToAnOrthonormalBasisThatReachesTheLimits) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed, 1};
    const int n_dof = 2 + static_cast<int>(random.uniform(0.0, 18.0));
    const VecX low = VecX::Constant(n_dof, -1.0);
    const VecX high = VecX::Constant(n_dof, 1.5);
    const EigengraspSpace small = random_space(random, n_dof, 2);
    const EigengraspSpace full = small.with_size(n_dof, low, high);
    ASSERT_EQ(full.size(), n_dof);
    EXPECT_LT((full.basis().transpose() * full.basis() - Eigen::MatrixXd::Identity(n_dof, n_dof)).norm(),
              1e-12);
    EXPECT_LT((full.basis().leftCols(2) - small.basis()).norm(), 1e-14);
    EXPECT_EQ(full[1].max, small[1].max);
    for (int k = 0; k < 20; ++k) {  // any posture within the limits is in reach of the added amplitudes
      VecX p(n_dof);
      for (int d = 0; d < n_dof; ++d) p[d] = random.uniform() < 0.5 ? low[d] : high[d];
      const VecX a = full.project(p);
      EXPECT_LT((full.embed(a) - p).norm(), 1e-12);
      for (int i = 2; i < n_dof; ++i) {
        EXPECT_GE(a[i], full[i].min - 1e-12);
        EXPECT_LE(a[i], full[i].max + 1e-12);
      }
    }
  }
}

TEST(EigengraspSpace, WithSizeOfFewerTakesTheFirst) {
  RandomStream random{3};
  const EigengraspSpace space = random_space(random, 6, 4);
  const VecX limit = VecX::Ones(6);
  EXPECT_LT((space.with_size(2, -limit, limit).basis() - space.basis().leftCols(2)).norm(), 1e-14);
  EXPECT_EQ(space.with_size(0, -limit, limit).size(), 0);
  EXPECT_EQ(space.with_size(0, -limit, limit).n_dof(), 6);
}

TEST(PostureComponents, OfThreePointsOnALineInClosedForm) {
  Eigen::MatrixXd rows(3, 2);
  rows << 0.0, 1.0, 3.0, 5.0, -3.0, -3.0;  // (0, 1) + t (3, 4), t = 0, 1, -1
  const PostureComponents pca = compute_posture_components(rows);
  EXPECT_LT((pca.mean - Eigen::Vector2d(0.0, 1.0)).norm(), 1e-15);
  EXPECT_LT((pca.directions.col(0) - Eigen::Vector2d(0.6, 0.8)).norm(), 1e-14);
  EXPECT_NEAR(pca.variance[0], 25.0, 1e-12);  // (25 + 25) / (3 - 1)
  EXPECT_NEAR(pca.variance[1], 0.0, 1e-12);
  EXPECT_NEAR(pca.explained(1), 1.0, 1e-14);
}

TEST(PostureComponents, OfAnIsotropicAndScaledCrossInClosedForm) {
  Eigen::MatrixXd rows(6, 3);
  rows << 3, 0, 0, -3, 0, 0, 0, 2, 0, 0, -2, 0, 0, 0, 1, 0, 0, -1;
  const PostureComponents pca = compute_posture_components(rows);
  EXPECT_LT((pca.variance - Eigen::Vector3d(18, 8, 2) / 5.0).norm(), 1e-13);
  EXPECT_LT((pca.directions - Mat3::Identity()).norm(), 1e-13);
  EXPECT_NEAR(pca.explained(1), 18.0 / 28.0, 1e-14);
  EXPECT_NEAR(pca.explained(2), 26.0 / 28.0, 1e-14);
}

TEST(PostureComponents, RefusesTooFewOrNonFiniteRows) {
  EXPECT_THAT(error_of([] { compute_posture_components(Eigen::MatrixXd::Zero(1, 4)); }),
              HasSubstr("at least 2 recorded postures, found 1"));
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 2);
  rows(1, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_of([&] { compute_posture_components(rows); }), HasSubstr("recorded posture 2"));
}

}  // namespace
}  // namespace eigengrasp
