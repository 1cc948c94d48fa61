// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Algorithm 1 on shipped objects: fitting, rating, scales, neighbours, hands.
#include <gtest/gtest.h>

#include <numbers>

#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/core/temporary_folder.hpp"
#include "eigengrasp/database/graspable_size.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/jobs/store_describe.hpp"
#include "eigengrasp/jobs/unit_planner.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/kinematics/hand_parts.hpp"
#include "eigengrasp/planning/pregrasp_fitting.hpp"
#include "eigengrasp/render/depth_camera.hpp"
#include "eigengrasp/scan/scan_surface.hpp"
#include "eigengrasp/transfer/grasp_transfer.hpp"
#include "support/shipped_scenes.hpp"

namespace eigengrasp {
namespace {

using testing::shipped_scene;
using testing::source_path;

CollisionModel exact_model(const Scene& scene) {
  CollisionModel::Options options;
  options.fast = false;
  return {scene, options};
}

Pose tilted() {
  return Pose(Eigen::Translation3d(0.1, -0.2, 0.05) *
              Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -0.5).normalized()));
}

PlanOptions plan_options() {
  PlanOptions options;
  options.search = SearchKind::transfer;
  options.threads = 2;
  return options;
}

TEST(BracketingScales, are_the_neighbours_in_size) {
  const std::vector<double> scales = {0.75, 1.0, 1.25, 1.5};
  EXPECT_EQ(bracketing_scales(0.1, 0.1, scales), (std::vector<double>{1.0, 1.25}));
  EXPECT_EQ(bracketing_scales(0.11, 0.1, scales), (std::vector<double>{1.0, 1.25}));
  EXPECT_EQ(bracketing_scales(0.05, 0.1, scales), (std::vector<double>{0.75}));
  EXPECT_EQ(bracketing_scales(0.2, 0.1, scales), (std::vector<double>{1.5}));
  EXPECT_TRUE(bracketing_scales(0.01, 0.1, scales).empty());
  EXPECT_TRUE(bracketing_scales(5.0, 0.1, scales).empty());
  EXPECT_TRUE(bracketing_scales(0.1, 0.1, {}).empty());
}

TEST(NeighborPose, brings_the_centres_together_and_keeps_lengths) {
  Alignment a;
  a.R = tilted().linear();
  a.center_model = {0.1, 0.2, 0.3};
  a.center_target = {-0.3, 0.1, 0.0};
  const Pose X_ON = neighbor_pose(a, 1.25);
  EXPECT_LT((X_ON * Vec3(1.25 * a.center_model) - a.center_target).norm(), 1e-15);
  EXPECT_LT((X_ON.linear() * X_ON.linear().transpose() - Mat3::Identity()).norm(), 1e-14);
}

TEST(ApproachFrame, stands_on_the_palm) {
  for (const char* name : {"human", "barrett-rubber", "dlr", "robonaut"}) {
    const Scene scene = shipped_scene(name, "glass");
    const Pose X_HA = approach_frame(*scene.hand);
    EXPECT_LT((X_HA.linear().transpose() * X_HA.linear() - Mat3::Identity()).norm(), 1e-12) << name;
    EXPECT_NEAR(X_HA.linear().determinant(), 1.0, 1e-12) << name;
    EXPECT_LT((X_HA.linear().col(2) - scene.hand->approach_direction_H).norm(), 1e-12) << name;
    EXPECT_LT((X_HA.translation() - scene.hand->approach_point_H).norm(), 1e-15) << name;
  }
}

TEST(OtherHand, keeps_the_share_of_the_range) {
  const Scene human = shipped_scene("human", "glass"), barrett = shipped_scene("barrett-rubber", "glass");
  const HandModel& from = *human.hand;
  const HandModel& to = *barrett.hand;
  const VecX zero = VecX::Zero(2);
  EXPECT_LT((posture_of_other_hand(from, zero, to) -
             clamp_posture(to, to.eigengrasps.embed(VecX::Zero(to.eigengrasps.size()))))
                .norm(),
            1e-12);
  VecX a(2);
  a << 0.3 * from.eigengrasps[0].max, 0.3 * from.eigengrasps[1].min;
  VecX b = VecX::Zero(to.eigengrasps.size());
  b[0] = 0.3 * to.eigengrasps[0].max;
  b[1] = 0.3 * to.eigengrasps[1].min;
  EXPECT_LT((posture_of_other_hand(from, a, to) - clamp_posture(to, to.eigengrasps.embed(b))).norm(), 1e-12);
}

TEST(FitPregrasp, frees_a_hand_that_is_inside_the_object_and_ends_in_contact) {
  for (const char* name : {"human", "barrett-rubber"}) {
    const Scene scene = shipped_scene(name, "flask");
    const CollisionModel model = exact_model(scene);
    const HandModel& hand = *scene.hand;
    // The approach point at the centre of mass: the palm is within the object.
    Pose X_OH = Pose::Identity();
    X_OH.linear() = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitY()).toRotationMatrix();
    X_OH.translation() = scene.object->center_of_mass - X_OH.linear() * hand.approach_point_H;
    const VecX closed = 0.5 * (hand.dof_min() + hand.dof_max());
    const FittedPreGrasp fitted = fit_pregrasp(model, X_OH, closed);
    ASSERT_TRUE(fitted.free) << name;
    EXPECT_GT(fitted.backwards, 0.0) << name;
    EXPECT_TRUE(fitted.touches) << name;
    std::vector<Pose> X_OL;
    double nearest = 1.0;
    for (const Pose& X : {fitted.X_OH_free, fitted.X_OH}) {
      compute_link_poses(hand, joint_values(hand, fitted.dofs), X, X_OL);
      nearest = 1.0;
      for (int i = 0; i < hand.n_links(); ++i) {
        const auto overlap = model.overlap_with_object(i, X_OL[static_cast<std::size_t>(i)]);
        EXPECT_FALSE(overlap.crosses || overlap.contained) << name << " link " << i;
        if (!model.surfaces().links[static_cast<std::size_t>(i)].empty())
          nearest = std::min(nearest, model.distance_to_object(i, X_OL[static_cast<std::size_t>(i)], 0.001));
      }
    }
    EXPECT_LE(nearest, 0.0001 + 1e-9) << name;  // at the end
    EXPECT_NEAR((fitted.X_OH.translation() - fitted.X_OH_free.translation()).norm(), fitted.forwards, 1e-9);
  }
}

TEST(FitPregrasp, leaves_a_free_pregrasp_that_misses_where_it_is) {
  const Scene scene = shipped_scene("human", "flask");
  Pose X_OH = Pose::Identity();
  X_OH.translation() = Vec3(0.0, 0.0, 3.0) + 3.0 * scene.hand->approach_direction_H;
  const FittedPreGrasp fitted = fit_pregrasp(exact_model(scene), X_OH, scene.hand->rest_posture());
  EXPECT_TRUE(fitted.free);
  EXPECT_FALSE(fitted.touches);
  EXPECT_EQ(fitted.X_OH.matrix(), X_OH.matrix());
  EXPECT_EQ(fitted.backwards, 0.0);
}

/// A store with the flask and the phone, whose grasps were planned here; made once.
class Transfer : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>("transfer");
    hand_ = shipped_scene("barrett-rubber", "flask").hand;
    store_ = open_store("sqlite:" + (folder_->path() / "g.db").string());
    store_->add_hand(hand_record(*hand_));
    store_->add_source({"test", ""});
    const PreparedHand prepared = prepare_hand(hand_, 2, nullptr);
    for (const char* object : {"flask", "phone"}) add(object, prepared);
    DescribeOptions options;
    options.neighbors = 1;
    const DescribeReport report = describe_store(*store_, options);
    ASSERT_EQ(report.described, 2u);
    ASSERT_TRUE(report.bad.empty());
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }

  static void add(const std::string& name, const PreparedHand& hand) {
    const auto file = source_path("data/objects") / (name + ".obj");
    const ObjectModel object = load_object(file);
    const StoredModel model{name,
                            file.string(),
                            content_hash(read_text_file(file)),
                            {"thing", name},
                            1.0,
                            approximate_radius(object.mesh, object.center_of_mass),
                            "",
                            {1.0}};
    store_->add_model(model);
    UnitOptions options;
    options.grasps = 8;
    PreparedObject prepared(model);
    UnitResult unit = *plan_unit({name, 1.0, hand_->name}, hand, prepared, options, nullptr);
    ASSERT_EQ(unit.grasps.size(), 8u);
    for (StoredGrasp& g : unit.grasps) g.source = "test";
    store_->finish_unit(unit);
  }

  /// The flask, turned, moved and scaled.
  Scene moved_flask(double scale) const {
    TriangleMesh mesh = load_object(source_path("data/objects/flask.obj")).mesh;
    transform(mesh, tilted(), scale);
    Scene scene;
    scene.hand = hand_;
    scene.object = std::make_shared<const ObjectModel>(make_object("new", std::move(mesh)));
    return scene;
  }

  TransferOptions options() const {
    TransferOptions o;
    o.candidates.neighbors = 1;
    o.candidates.most = 0;
    o.plan = plan_options();
    return o;
  }

  std::string error_of(const Scene& scene, const TransferOptions& options) {
    try {
      transfer_grasps(scene, TransferStore(*store_), options);
    } catch (const Error& e) {
      return e.what();
    }
    return "(no error)";
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::shared_ptr<const HandModel> hand_;
  static inline std::unique_ptr<GraspStore> store_;
};

TEST_F(Transfer, brings_the_grasps_of_an_object_to_a_turned_and_scaled_copy) {
  for (const double scale : {1.0, 1.05}) {
    const Scene scene = moved_flask(scale);
    const TransferResult result = transfer_grasps(scene, TransferStore(*store_), options());
    ASSERT_EQ(result.neighbors.size(), 1u);
    EXPECT_EQ(result.neighbors[0].object, "flask");
    EXPECT_LT(result.neighbors[0].distance, 0.02);
    EXPECT_EQ(result.neighbors[0].candidates, 8);
    EXPECT_EQ(result.plan.status, PlanStatus::found) << result.plan.explanation;
    EXPECT_GE(result.form_closed[0], 5) << result.plan.explanation;
    EXPECT_EQ(result.origins.size(), result.plan.grasps.size());
    double last = 1.0;
    const CollisionModel model = exact_model(scene);
    for (const Grasp& g : result.plan.grasps) {
      EXPECT_TRUE(g.form_closure);
      EXPECT_LE(g.epsilon, last);
      last = g.epsilon;
      EXPECT_EQ(g.provenance.planner, "transfer/zernike/pca");
      std::vector<Pose> X_OL;
      compute_link_poses(*hand_, joint_values(*hand_, g.pregrasp_dofs), g.X_OH_pregrasp, X_OL);
      EXPECT_EQ(model.check_exact(X_OL), Legality::legal);
    }
  }
}

/// What a camera sees of the object, as a scan of which a surface was made.
ObjectModel scanned(const ObjectModel& object, const Vec3& to_camera) {
  DepthCamera depth;
  depth.camera = frame_camera(bounding_box(object.mesh), -to_camera, Vec3::UnitZ());
  depth.camera.position += 0.2 * to_camera.normalized();
  depth.columns = depth.rows = 240;
  return make_scanned_object("scan", make_scan_surface({take_depth_view(object.mesh, depth, 1)}));
}

TEST_F(Transfer, finds_a_scan_of_one_side_among_the_views) {
  Scene scene = moved_flask(1.0);
  const Vec3 to_camera = tilted().linear() * Vec3(0.5, -0.9, 0.4);
  scene.object = std::make_shared<const ObjectModel>(scanned(*scene.object, to_camera));
  const TransferResult result = transfer_grasps(scene, TransferStore(*store_), options());
  ASSERT_EQ(result.neighbors.size(), 1u);
  EXPECT_EQ(result.neighbors[0].object, "flask");
  EXPECT_EQ(result.neighbors[0].alignment.method, kIcpAlignment);
  ASSERT_EQ(result.plan.status, PlanStatus::found) << result.plan.explanation;
  EXPECT_EQ(result.plan.grasps[0].provenance.planner, "transfer/views/pca-icp");
}

TEST_F(Transfer, looks_only_scans_up_among_the_views) {
  TransferOptions o = options();
  o.distance = NeighborDistance::views;
  EXPECT_NE(error_of(moved_flask(1.0), o).find("no scan of one side"), std::string::npos);
}

TEST_F(Transfer, does_not_depend_on_the_number_of_threads) {
  const Scene scene = moved_flask(1.02);
  TransferOptions one = options(), four = options();
  one.candidates.neighbors = four.candidates.neighbors = 2;
  one.plan.threads = 1;
  four.plan.threads = 4;
  four.candidates.threads = 4;
  const TransferResult a = transfer_grasps(scene, TransferStore(*store_), one);
  const TransferResult b = transfer_grasps(scene, TransferStore(*store_), four);
  ASSERT_EQ(a.plan.grasps.size(), b.plan.grasps.size());
  for (std::size_t i = 0; i < a.plan.grasps.size(); ++i) {
    EXPECT_EQ(a.plan.grasps[i].epsilon, b.plan.grasps[i].epsilon);
    EXPECT_EQ(a.plan.grasps[i].X_OH.matrix(), b.plan.grasps[i].X_OH.matrix());
  }
  EXPECT_EQ(a.plan.explanation, b.plan.explanation);
}

TEST_F(Transfer, tries_the_best_candidates_of_the_nearest_neighbour_first) {
  const TransferStore store(*store_);
  const Scene scene = moved_flask(1.0);
  TransferTarget target(store, *scene.object);
  NeighborQuery query;
  query.values = describe_object(scene.object->mesh).values;
  CandidateOptions choice;
  choice.neighbors = 2;
  choice.most = 3;
  const Candidates found = target.find_candidates(rank_neighbors(store, query), {hand_, hand_}, choice);
  ASSERT_EQ(found.neighbors.size(), 2u);
  EXPECT_EQ(found.neighbors[0].object, "flask");
  EXPECT_EQ(found.neighbors[0].candidates, 3);
  for (std::size_t i = 1; i < found.origins.size(); ++i) {
    EXPECT_GE(found.origins[i].neighbor, found.origins[i - 1].neighbor);
    if (found.origins[i].neighbor == found.origins[i - 1].neighbor) {
      EXPECT_LE(found.origins[i].grasp.epsilon, found.origins[i - 1].grasp.epsilon);
    }
  }
}

TEST_F(Transfer, leaves_out_what_it_is_told_to) {
  TransferOptions o = options();
  o.without = {"flask"};
  const TransferResult result = transfer_grasps(moved_flask(1.0), TransferStore(*store_), o);
  ASSERT_EQ(result.neighbors.size(), 1u);
  EXPECT_EQ(result.neighbors[0].object, "phone");
  o.without = {"flask", "phone"};
  EXPECT_NE(error_of(moved_flask(1.0), o).find("holds no form-closed grasps"), std::string::npos);
}

TEST_F(Transfer, goes_by_class) {
  TransferOptions o = options();
  o.distance = NeighborDistance::classes;
  EXPECT_NE(error_of(moved_flask(1.0), o).find("has no class"), std::string::npos);
  o.tags = {"thing", "phone"};
  const TransferResult result = transfer_grasps(moved_flask(1.0), TransferStore(*store_), o);
  EXPECT_EQ(result.neighbors[0].object, "phone");
  EXPECT_EQ(result.neighbors[0].distance, 0.0);
}

TEST_F(Transfer, goes_from_hand_to_hand) {
  const Scene human = shipped_scene("human", "flask");
  TransferOptions o = options();
  o.from_hand = hand_;
  const TransferResult result = transfer_grasps(human, TransferStore(*store_), o);
  EXPECT_EQ(result.neighbors[0].candidates, 8);
  EXPECT_EQ(result.plan.status, PlanStatus::found) << result.plan.explanation;
}

TEST_F(Transfer, says_what_is_wrong) {
  const Scene human = shipped_scene("human", "flask");
  EXPECT_NE(
      error_of(human, options()).find("no grasps with the hand 'human'; it has those with barrett-rubber"),
      std::string::npos);
  TransferOptions o = options();
  o.candidates.alignment = "icp";
  EXPECT_NE(error_of(moved_flask(1.0), o).find("the alignment is 'icp', expected pca or pca-icp"),
            std::string::npos);
  const auto empty = open_store("sqlite:" + (folder_->path() / "empty.db").string());
  EXPECT_THROW(TransferStore{*empty}, Error);
  // Fifty times as large: no grasps, and why.
  const TransferResult result = transfer_grasps(moved_flask(50.0), TransferStore(*store_), options());
  EXPECT_EQ(result.plan.status, PlanStatus::nothing_legal);
  EXPECT_NE(result.plan.explanation.find("are the units right?"), std::string::npos)
      << result.plan.explanation;
}

TEST_F(Transfer, a_store_that_is_described_again_changes_nothing) {
  const StoreCounts before = store_->counts();
  EXPECT_EQ(before.neighbors, 2);
  EXPECT_EQ(before.alignments, 4);
  DescribeOptions options;
  options.neighbors = 1;
  const DescribeReport report = describe_store(*store_, options);
  EXPECT_EQ(report.there, 2u);
  EXPECT_EQ(report.described + report.neighbors + report.alignments, 0u);
  EXPECT_EQ(store_->counts(), before);
}

}  // namespace
}  // namespace eigengrasp
