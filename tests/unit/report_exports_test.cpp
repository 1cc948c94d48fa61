// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <map>
#include <sstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/report/grasp_glb.hpp"
#include "eigengrasp/report/grasp_tables.hpp"
#include "eigengrasp/report/model_glb.hpp"
#include "support/gripper.hpp"

namespace eigengrasp {
namespace {

using testing::ball_grasp;
using testing::ball_scene;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

TEST(GraspTable, HasALineForEachGraspAndAlignedColumns) {
  const Scene scene = ball_scene();
  std::vector<Grasp> grasps(12, ball_grasp());
  grasps[3].form_closure = false;
  const auto lines = split(grasps_table(*scene.hand, grasps), '\n');
  ASSERT_EQ(lines.size(), 13U);
  for (const std::string& line : lines) EXPECT_EQ(line.size(), lines[0].size()) << line;
  EXPECT_NE(lines[1].find("0.2135"), std::string::npos);
  EXPECT_NE(lines[1].find("yes"), std::string::npos);
  EXPECT_EQ(lines[4].find("yes"), std::string::npos);
  EXPECT_EQ(split(grasps_table(*scene.hand, grasps, 5), '\n').size(), 6U);
}

TEST(GraspTable, CountsFingersNotLinks) {
  const Scene scene = ball_scene();
  Grasp grasp = ball_grasp();
  EXPECT_EQ(touching_parts(*scene.hand, grasp).fingers, 2);
  EXPECT_FALSE(touching_parts(*scene.hand, grasp).palm);
  grasp.contacts[0].link = "right_proximal";
  EXPECT_EQ(touching_parts(*scene.hand, grasp).fingers, 1);
  grasp.contacts[0].link = "palm";
  EXPECT_EQ(touching_parts(*scene.hand, grasp).fingers, 1);
  EXPECT_TRUE(touching_parts(*scene.hand, grasp).palm);
}

TEST(GraspCsv, HasTheSameColumnsInEachRow) {
  std::vector<Grasp> grasps(3, ball_grasp());
  const auto rows = split(grasps_csv(grasps), '\n');
  ASSERT_EQ(rows.size(), 4U);
  const auto headings = split(rows[0], ',');
  EXPECT_EQ(headings.size(), 10U + 2 * 7 + 2 * 4);
  EXPECT_EQ(headings[0], "rank");
  EXPECT_EQ(headings[24], "pregrasp:left_proximal");
  for (const std::string& row : rows) EXPECT_EQ(split(row, ',').size(), headings.size());
  const auto cells = split(rows[2], ',');
  EXPECT_EQ(cells[0], "2");
  EXPECT_EQ(std::stod(cells[4]), ball_grasp().epsilon);
  EXPECT_EQ(cells[6], "0.30000000000000004");
}

TEST(GraspCsv, QuotesNamesWithCommas) {
  Grasp grasp = ball_grasp();
  grasp.object = "ball, \"red\"";
  EXPECT_NE(grasps_csv(std::vector<Grasp>{grasp}).find(",\"ball, \"\"red\"\"\","), std::string::npos);
  EXPECT_EQ(split(grasps_csv({}), '\n').size(), 1U);
}

TEST(IsaacGrasp, HasTheMembersOfTheFormat) {
  const auto hand = testing::two_finger_hand();
  const std::string yaml = isaac_grasp_yaml(*hand, std::vector<Grasp>{ball_grasp()});
  for (const char* part : {"format: isaac_grasp\n", "format_version: 1.0\n", "gripper_frame_link: \"palm\"",
                           "\"grasp_0\":", "confidence: 0.2134567890123456\n",
                           "orientation: {w: 1, xyz: [0, 0, 0]}", "\"left_distal\": 0.3333333333333333"})
    EXPECT_NE(yaml.find(part), std::string::npos) << part << "\n" << yaml;
}

class Glb : public ::testing::Test {
 protected:
  const aiScene* read(const std::string& bytes) {
    return importer_.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  }
  Assimp::Importer importer_;
};

TEST_F(Glb, ReadBackHasEveryTriangleNodeAndMaterial) {
  Scene scene = ball_scene();
  scene.obstacles.push_back(
      {std::make_shared<const ObjectModel>(make_object("table", testing::box_mesh({2.0, 2.0, 0.05}))),
       make_pose(Eigen::Quaterniond::Identity(), {0.0, 0.0, -0.1})});
  const std::string bytes = grasp_glb(scene, ball_grasp());
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  const aiScene* read_back = read(bytes);
  ASSERT_NE(read_back, nullptr) << importer_.GetErrorString();
  std::map<std::string, unsigned> triangles;
  for (unsigned n = 0; n < read_back->mRootNode->mNumChildren; ++n) {
    const aiNode& node = *read_back->mRootNode->mChildren[n];
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      triangles[node.mName.C_Str()] += read_back->mMeshes[node.mMeshes[i]]->mNumFaces;
  }
  EXPECT_EQ(triangles.size(), 5U + 1 + 1 + 2);
  EXPECT_EQ(triangles["link:palm"], 12U);
  EXPECT_EQ(triangles["link:right_distal"], 12U);
  EXPECT_EQ(triangles["object:ball"], scene.object->mesh.triangles.size());
  EXPECT_EQ(triangles["obstacle:table"], 12U);
  EXPECT_EQ(triangles["contact:2"], 128U);
  EXPECT_GE(read_back->mNumMaterials, 4U);
}

TEST_F(Glb, BoxesKeepTheirEdgesAndBallsShareVertices) {
  const Scene scene = ball_scene();
  const aiScene* read_back = read(grasp_glb(scene, ball_grasp()));
  ASSERT_NE(read_back, nullptr);
  for (unsigned m = 0; m < read_back->mNumMeshes; ++m) {
    const aiMesh& mesh = *read_back->mMeshes[m];
    if (mesh.mNumFaces == 12) {
      EXPECT_EQ(mesh.mNumVertices, 24U) << mesh.mName.C_Str();
    }
    if (mesh.mNumFaces == scene.object->mesh.triangles.size()) {
      EXPECT_LT(mesh.mNumVertices, mesh.mNumFaces);
    }
  }
}

TEST_F(Glb, AHandAloneHasANodeForEachLinkInItsOwnFrame) {
  const Scene scene = ball_scene();
  const aiScene* read_back = read(hand_glb(*scene.hand));
  ASSERT_NE(read_back, nullptr) << importer_.GetErrorString();
  EXPECT_STREQ(read_back->mRootNode->mName.C_Str(), "hand");
  EXPECT_TRUE(read_back->mRootNode->mTransformation.IsIdentity());
  ASSERT_EQ(read_back->mRootNode->mNumChildren, scene.hand->links.size());
  for (std::size_t i = 0; i < scene.hand->links.size(); ++i) {
    const HandLink& link = scene.hand->links[i];
    const aiNode* node = read_back->mRootNode->FindNode(link.name.c_str());
    ASSERT_NE(node, nullptr) << link.name;
    EXPECT_TRUE(node->mTransformation.IsIdentity());
    const aiMesh& mesh = *read_back->mMeshes[node->mMeshes[0]];
    Box box;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      box.add(Vec3(mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z));
    EXPECT_TRUE(box.min.isApprox(bounding_box(link.mesh).min, 1e-6)) << link.name;
    EXPECT_TRUE(box.max.isApprox(bounding_box(link.mesh).max, 1e-6)) << link.name;
  }
  const aiScene* object = read(object_glb(*scene.object));
  ASSERT_NE(object, nullptr) << importer_.GetErrorString();
  EXPECT_NE(object->mRootNode->FindNode("object"), nullptr);
}

TEST_F(Glb, PlacesThePartsWithYUp) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "eigengrasp_report.glb";
  Grasp grasp = ball_grasp();
  grasp.contacts.clear();
  save_grasp_glb(ball_scene(), grasp, path);
  const Box box = bounding_box(load_mesh(path));
  // The palm's underside is 90 mm below the ball's centre, along -y of glTF; its width stays along x.
  EXPECT_NEAR(box.min.y(), -0.09, 1e-6);
  EXPECT_NEAR(box.min.z(), -0.03, 1e-6);
  EXPECT_LT(box.min.x(), -0.0599);
  std::filesystem::remove(path);
}

TEST_F(Glb, RefusesJointsThatTheHandDoesNotHave) {
  Grasp grasp = ball_grasp();
  grasp.grasp_joints.emplace_back("thumb", 1.0);
  EXPECT_THROW(grasp_glb(ball_scene(), grasp), Error);
  EXPECT_NO_THROW(grasp_glb(ball_scene(), grasp, GraspPhase::pregrasp));
}

}  // namespace
}  // namespace eigengrasp
