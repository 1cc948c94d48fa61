// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Alignment of shapes that were moved, mirrored, cut, and of those that have symmetries or nearly.
#include "eigengrasp/shape/shape_alignment.hpp"

#include <gtest/gtest.h>

#include "eigengrasp/core/error.hpp"
#include "support/solid_shapes.hpp"
#include "unit/shape_test_shapes.hpp"

namespace eigengrasp::testing {
namespace {

/// A box with nearly equal sides, and a knob that tells its ends apart.
TriangleMesh nearly_a_cube() {
  TriangleMesh mesh = box_about({1.0, 1.03, 0.98}, Vec3::Zero());
  append(mesh, box_about({0.3, 0.2, 0.2}, {0.6, 0.3, 0.2}));
  return mesh;
}

/// How far the points of the mesh land from where they belong, at most, over the size.
double misplaced(const TriangleMesh& mesh, const Alignment& a, const Mat3& R, double scale,
                 const Vec3& shift) {
  const Eigen::Matrix4d X = a.matrix(a.scale);
  double worst = 0.0;
  for (const Vec3& p : mesh.vertices)
    worst = std::max(worst, ((X * p.homogeneous()).head<3>() - (scale * (R * p) + shift)).norm());
  return worst / (scale * bounding_box(mesh).diagonal());
}

TEST(Alignment, FindsTheMotionOfAShapeWithoutSymmetry) {
  const TriangleMesh mesh = chiral_shape();
  const AlignmentShape shape = make_alignment_shape(mesh);
  RandomStream stream{5};
  for (int i = 0; i < 20; ++i) {
    const Mat3 R = random_rotation(stream);
    const Vec3 shift(stream.normal(), stream.normal(), stream.normal());
    const AlignmentShape target = make_alignment_shape(moved(mesh, R, 2.5, shift));
    const Alignment pca = align_by_pca(shape, target), icp = align_by_icp(shape, target);
    EXPECT_LT(misplaced(mesh, pca, R, 2.5, shift), 1e-6);
    EXPECT_LT(misplaced(mesh, icp, R, 2.5, shift), 1e-6);
    EXPECT_NEAR(pca.scale, 2.5, 1e-9);
    EXPECT_GT(pca.overlap, 0.99);
    EXPECT_EQ(pca.candidates, 4);
    EXPECT_EQ(pca.method, "pca");
    EXPECT_EQ(icp.method, "pca-icp");
  }
}

TEST(Alignment, OfAMirroredShapeIsARotationAndSaysThatItDoesNotFit) {
  TriangleMesh mirrored = chiral_shape();
  for (Vec3& v : mirrored.vertices) v.x() = -v.x();
  for (auto& t : mirrored.triangles) std::swap(t[0], t[1]);
  const AlignmentShape shape = make_alignment_shape(chiral_shape()), target = make_alignment_shape(mirrored);
  for (const Alignment& a : {align_by_pca(shape, target), align_by_icp(shape, target)}) {
    EXPECT_NEAR(a.R.determinant(), 1.0, 1e-9);
    EXPECT_GT(a.distance, 0.02);
    EXPECT_LT(a.overlap, 0.99);
  }
}

TEST(Alignment, OfANearlySymmetricShapeTriesQuarterTurns) {
  const TriangleMesh mesh = nearly_a_cube();
  const AlignmentShape shape = make_alignment_shape(mesh);
  RandomStream stream{6};
  for (int i = 0; i < 10; ++i) {
    const Mat3 R = random_rotation(stream);
    const AlignmentShape target = make_alignment_shape(moved(mesh, R, 1.0, Vec3::Ones()));
    const Alignment icp = align_by_icp(shape, target);
    EXPECT_LT(misplaced(mesh, icp, R, 1.0, Vec3::Ones()), 1e-3);
    EXPECT_GE(align_by_pca(shape, target).candidates, 8);
  }
}

TEST(Alignment, OfARoundShapeFitsWhateverTheTurn) {
  const TriangleMesh mesh = cup_mesh(0.05, 0.1, 0.005);
  const AlignmentShape shape = make_alignment_shape(mesh);
  RandomStream stream{8};
  const Mat3 R = random_rotation(stream);
  const Alignment a = align_by_icp(shape, make_alignment_shape(moved(mesh, R, 1.0, Vec3::Zero())));
  EXPECT_LT(a.distance, 0.01);
  EXPECT_LT(((a.R - R) * Vec3::UnitZ()).norm(), 0.02);
}

TEST(Alignment, IcpIsNeverWorseThanPcaAndBetterOnAnotherShape) {
  const AlignmentShape a = make_alignment_shape(chiral_shape());
  TriangleMesh longer = box_about({1.2, 0.2, 0.2}, {0.6, 0.0, 0.0});
  append(longer, box_about({0.2, 0.5, 0.3}, {1.1, 0.3, 0.0}));
  append(longer, box_about({0.2, 0.2, 0.6}, {0.1, 0.0, 0.4}));
  const AlignmentShape b = make_alignment_shape(longer);
  EXPECT_LT(align_by_icp(a, b).distance, align_by_pca(a, b).distance);
}

AlignmentOptions one_sided() {
  AlignmentOptions options;
  options.match_scale = false;
  options.one_sided = true;
  options.iterations = 40;
  return options;
}

TEST(Alignment, OneSidedLaysAPartUponTheWhole) {
  const TriangleMesh whole = chiral_shape();
  TriangleMesh part = whole;
  part.triangles.resize(part.triangles.size() - 6);  // half of the shortest bar is not seen
  RandomStream stream{9};
  const Mat3 R = random_rotation(stream);
  const Alignment a = align_by_icp(make_alignment_shape(part),
                                   make_alignment_shape(moved(whole, R, 1.0, Vec3::Zero())), one_sided());
  EXPECT_EQ(a.scale, 1.0);
  EXPECT_LT(a.distance, 0.02);
  EXPECT_LT(misplaced(part, a, R, 1.0, Vec3::Zero()), 0.03);
}

// The guess lies the unseen half elsewhere; only what was seen tells.
TEST(Alignment, AScanIsLaidUponTheWholeByWhatWasSeen) {
  const TriangleMesh whole = chiral_shape();
  TriangleMesh seen = whole;
  seen.triangles.resize(seen.triangles.size() - 6);
  TriangleMesh guessed = seen;
  append(guessed, box_about({0.2, 0.2, 0.5}, {0.5, 0.0, -0.35}));  // a bar that is not there
  RandomStream stream{11};
  const Mat3 R = random_rotation(stream);
  const AlignmentShape target = make_alignment_shape(moved(whole, R, 1.0, Vec3::Zero()));
  const Alignment a = align_by_icp(make_alignment_shape(guessed, seen), target, one_sided());
  EXPECT_LT(a.distance, 0.02);
  EXPECT_LT(misplaced(seen, a, R, 1.0, Vec3::Zero()), 0.03);
  const Alignment with_guess = align_by_icp(make_alignment_shape(guessed), target, one_sided());
  EXPECT_GT(misplaced(seen, with_guess, R, 1.0, Vec3::Zero()), 0.03);
}

TEST(Alignment, TheInverseLeadsBack) {
  const AlignmentShape a = make_alignment_shape(chiral_shape());
  RandomStream stream{12};
  const AlignmentShape b =
      make_alignment_shape(moved(chiral_shape(), random_rotation(stream), 1.7, Vec3(1.0, 2.0, 3.0)));
  const Alignment there = align_by_icp(a, b), back = inverse(there);
  EXPECT_LT((back.matrix(back.scale) * there.matrix(there.scale) - Eigen::Matrix4d::Identity()).norm(),
            1e-12);
}

TEST(Alignment, ShapesWithoutAreaAreRefused) {
  EXPECT_THROW(make_alignment_shape({}), Error);
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  line.triangles = {{0, 1, 2}};
  EXPECT_THROW(make_alignment_shape(line), Error);
}

}  // namespace
}  // namespace eigengrasp::testing
