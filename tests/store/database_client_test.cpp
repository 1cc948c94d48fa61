// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// The SQL that GraspIt!'s database client sends, and what it makes of the answers, against what was stored.
#include "store/store_fixture.hpp"

namespace eigengrasp {
namespace {

using testing::PostgresServer;
using Rows = std::vector<std::vector<std::string>>;

class CgdbClient : public testing::StoreFixture {
 protected:
  void SetUp() override {
    if (!available("postgresql")) GTEST_SKIP() << PostgresServer::why_none();
    address_ = new_address("postgresql");
    store_ = open_store(address_);
    fill_tables(*store_);
    unit_ = done({"psb_12", 0.75, "barrett"}, 3, 1);
    store_->finish_unit(unit_);
  }
  Rows ask(const std::string& sql) const { return PostgresServer::query(address_, sql); }
  /// A cell by the name of its column, as the client looks for it.
  static std::string cell(const Rows& rows, std::size_t row, const std::string& column) {
    const auto found = std::find(rows[0].begin(), rows[0].end(), column);
    if (found == rows[0].end()) throw std::runtime_error("there is no column " + column);
    return rows.at(row + 1)[static_cast<std::size_t>(found - rows[0].begin())];
  }
  /// The numbers of an array without the first, which the client drops.
  static std::vector<double> array(const std::string& text, bool drop_first) {
    std::vector<double> numbers;
    for (const char* p = text.c_str() + 1; *p && *p != '}'; p += *p == ',')
      numbers.push_back(std::strtod(p, const_cast<char**>(&p)));
    if (drop_first) numbers.erase(numbers.begin());
    return numbers;
  }

  std::string address_;
  std::unique_ptr<GraspStore> store_;
  UnitResult unit_;
};

TEST_F(CgdbClient, lists_models_with_scales_and_millimetres) {
  const Rows rows = ask("SELECT * FROM get_models();");
  ASSERT_EQ(rows.size(), 1u + 6u);
  EXPECT_EQ(cell(rows, 0, "model_name"), "psb_0.75_12");
  EXPECT_EQ(cell(rows, 4, "model_name"), "glass_0.75");
  EXPECT_EQ(cell(rows, 4, "thumbnail_path"), "thumbnails/glass.png");
  EXPECT_EQ(cell(rows, 0, "geometry_path"), "/meshes/m12.off");
  EXPECT_EQ(cell(rows, 3, "scale"), "1.5");
  EXPECT_EQ(cell(rows, 0, "tags"), "{plane,\"F \\\"117\\\", {old}\"}");
  EXPECT_NEAR(std::stod(cell(rows, 0, "grasping_rescale")), 123.4567890123456, 1e-10);  // file units to mm
}

TEST_F(CgdbClient, loads_grasps_in_its_conventions) {
  const Rows rows = ask("SELECT * FROM get_grasps('psb_0.75_12','barrett');");
  ASSERT_EQ(rows.size(), 1u + 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Grasp& g = unit_.grasps[i].grasp;
    const auto joints = array(cell(rows, i, "grasp_grasp_joints"), true);
    EXPECT_EQ(joints, std::vector<double>(g.grasp_dofs.begin(), g.grasp_dofs.end()));
    EXPECT_EQ(array(cell(rows, i, "grasp_pregrasp_joints"), false)[0], 5.0);
    const auto p = array(cell(rows, i, "grasp_pregrasp_position"), true);
    ASSERT_EQ(p.size(), 7u);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(p[static_cast<std::size_t>(k)], 1000.0 * g.X_OH_pregrasp.translation()[k], 1e-9);
    const Eigen::Quaterniond q(p[3], p[4], p[5], p[6]);  // w, x, y, z
    EXPECT_TRUE(q.toRotationMatrix().isApprox(g.X_OH_pregrasp.linear(), 1e-12));
    EXPECT_EQ(array(cell(rows, i, "grasp_grasp_position"), false)[0], 0.0);
    const auto contacts = array(cell(rows, i, "grasp_contacts"), false);
    ASSERT_EQ(contacts.size(), 3 * g.contacts.size());
    EXPECT_NEAR(contacts[4], 1000.0 * g.contacts[1].point.p_OC.y(), 1e-9);
    EXPECT_EQ(std::stod(cell(rows, i, "grasp_epsilon_quality")), g.epsilon);
    EXPECT_EQ(std::stod(cell(rows, i, "grasp_volume_quality")), g.volume);
    EXPECT_EQ(cell(rows, i, "grasp_source_name"), "planner");
    EXPECT_GT(std::stoi(cell(rows, i, "grasp_id")), 0);
  }
  EXPECT_EQ(ask("SELECT * FROM get_grasps('psb_1_12','barrett');").size(), 1u);
}

TEST_F(CgdbClient, saves_a_grasp_that_we_read) {
  ask("SELECT * FROM save_grasp('psb_0.75_12','barrett', '{5, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}', "
      "'{0, 10, 20, -30, 0, 1, 0, 0}', '{5, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}', '{0, 1, 2, 3, 1, 0, 0, 0}', "
      "'{1, 2, 3, 4, 5, 6}', -13, 0.1, 0.1, 'HUMAN_REFINED')");
  const auto grasps = store_->grasps("psb_12", "barrett");
  ASSERT_EQ(grasps.size(), 4u);
  const Grasp& g = grasps[3].grasp;
  EXPECT_EQ(grasps[3].source, "HUMAN_REFINED");
  EXPECT_EQ(g.object, "psb_12");
  EXPECT_EQ(g.object_scale, 0.75);
  EXPECT_TRUE(g.X_OH.translation().isApprox(Vec3(0.001, 0.002, 0.003), 1e-12));
  EXPECT_TRUE(g.X_OH_pregrasp.translation().isApprox(Vec3(0.01, 0.02, -0.03), 1e-12));
  EXPECT_TRUE(g.X_OH_pregrasp.linear().isApprox(Vec3(1, -1, -1).asDiagonal().toDenseMatrix(), 1e-12));
  ASSERT_EQ(g.grasp_dofs.size(), 6);
  EXPECT_EQ(g.grasp_dofs[5], 0.7);
  ASSERT_EQ(g.contacts.size(), 2u);
  EXPECT_TRUE(g.contacts[1].point.p_OC.isApprox(Vec3(0.004, 0.005, 0.006), 1e-12));
  EXPECT_EQ(g.epsilon, 0.1);
  EXPECT_EQ(g.energy, -13.0);
  EXPECT_EQ(store_->units().size(), 1u);
  EXPECT_EQ(ask("SELECT * FROM get_grasps('psb_0.75_12','barrett');").size(), 1u + 4u);
}

TEST_F(CgdbClient, is_told_what_was_wrong_with_a_grasp) {
  const std::string arrays = "'{5, 0.1}', '{0, 0, 0, 0, 1, 0, 0, 0}', '{5, 0.1}', '{0, 0, 0, 0, 1, 0, 0, 0}'";
  EXPECT_THROW(ask("SELECT * FROM save_grasp('cup','barrett', " + arrays + ", '{}', 0, 0, 0, 'x')"),
               std::runtime_error);
  EXPECT_THROW(ask("SELECT * FROM save_grasp('psb_1_12','claw', " + arrays + ", '{}', 0, 0, 0, 'x')"),
               std::runtime_error);
  EXPECT_THROW(
      ask("SELECT * FROM save_grasp('psb_1_12','barrett', '{5}', '{0, 1}', '{5}', '{0, 1}', '{}', 0, 0, "
          "0, 'x')"),
      std::runtime_error);
  EXPECT_EQ(store_->counts().grasps, 3);
}

TEST_F(CgdbClient, asks_for_neighbours_and_alignments) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m(0, 3) = 0.25;
  m(1, 2) = -2.0;
  store_->set_alignments({{"psb_12", "glass", "pca", m}});
  store_->set_neighbors({{"psb_12", "glass", "zernike", 0.5}, {"psb_12", "psb_12", "zernike", 0.0}});
  Rows rows = ask("SELECT * FROM get_saved_neighbors('psb_0.75_12','zernike',25);");
  ASSERT_EQ(rows.size(), 1u + 2u);
  EXPECT_EQ(cell(rows, 0, "model_name"), "psb_0.75_12");
  EXPECT_EQ(cell(rows, 1, "model_name"), "glass_0.75");
  EXPECT_EQ(cell(rows, 1, "distance"), "0.5");
  EXPECT_EQ(cell(rows, 1, "grasping_rescale"), "1000");
  EXPECT_EQ(ask("SELECT * FROM get_saved_neighbors('psb_0.75_12','zernike',1);").size(), 1u + 1u);
  rows = ask("SELECT get_alignment('psb_1_12','glass_1','pca')");
  const std::vector<double> expected = {1, 0, 0, 250, 0, 1, -2, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(array(rows.at(1)[0], false), expected);
  EXPECT_EQ(cell(ask("SELECT * FROM get_distance_function_names();"), 0, "distance_function_name"),
            "zernike");
  EXPECT_EQ(cell(ask("SELECT * FROM get_alignment_method_names();"), 0, "alignment_method_name"), "pca");
  EXPECT_EQ(cell(ask("SELECT * FROM get_grasp_type_names();"), 0, "grasp_type_name"), "planner");
}

}  // namespace
}  // namespace eigengrasp
