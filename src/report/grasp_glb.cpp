// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/report/grasp_glb.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <numbers>
#include <stdexcept>

#include "corner_normals.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"

namespace eigengrasp {

namespace {

constexpr double kBallRadius = 0.003;  // of a contact [m]
constexpr double kCreaseAngle = 40.0 * std::numbers::pi / 180.0;

enum Look : unsigned { hand_look, object_look, obstacle_look, contact_look, look_count };

struct LookColor {
  const char* name;
  float r, g, b;  // linear
};
constexpr LookColor kColors[look_count] = {{"hand", 0.70F, 0.60F, 0.45F},
                                           {"object", 0.11F, 0.27F, 0.57F},
                                           {"obstacle", 0.60F, 0.60F, 0.58F},
                                           {"contact", 0.67F, 0.01F, 0.01F}};

aiMaterial* make_material(const LookColor& look) {
  auto* material = new aiMaterial;
  const aiString name(look.name);
  const aiColor4D color(look.r, look.g, look.b, 1.0F);
  const float metallic = 0.0F;
  const float roughness = 0.6F;
  const int two_sided = 1;
  material->AddProperty(&name, AI_MATKEY_NAME);
  material->AddProperty(&color, 1, AI_MATKEY_BASE_COLOR);
  material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
  material->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  material->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  material->AddProperty(&two_sided, 1, AI_MATKEY_TWOSIDED);
  return material;
}

aiVector3D to_assimp(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

aiMatrix4x4 to_assimp(const Pose& X) {
  aiMatrix4x4 m;
  for (unsigned r = 0; r < 3; ++r)
    for (unsigned c = 0; c < 4; ++c) m[r][c] = static_cast<float>(X.matrix()(r, c));
  return m;
}

/// Each triangle with vertices of its own; the exporter joins those that are alike.
aiMesh* make_mesh(const TriangleMesh& mesh, const std::string& name, Look look) {
  auto* part = new aiMesh;
  part->mName = aiString(name);
  part->mMaterialIndex = look;
  part->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  const std::size_t n = mesh.triangles.size();
  part->mNumFaces = static_cast<unsigned>(n);
  part->mNumVertices = static_cast<unsigned>(3 * n);
  part->mFaces = new aiFace[n];
  part->mVertices = new aiVector3D[3 * n];
  part->mNormals = new aiVector3D[3 * n];
  const auto normals = corner_normals_of(mesh, kCreaseAngle);
  for (std::size_t t = 0; t < n; ++t) {
    part->mFaces[t].mNumIndices = 3;
    part->mFaces[t].mIndices = new unsigned[3];
    for (std::size_t k = 0; k < 3; ++k) {
      part->mFaces[t].mIndices[k] = static_cast<unsigned>(3 * t + k);
      part->mVertices[3 * t + k] = to_assimp(mesh.corner(t, static_cast<int>(k)));
      part->mNormals[3 * t + k] = to_assimp(normals[t][k]);
    }
  }
  return part;
}

/// Octahedron whose triangles are cut into four, twice.
TriangleMesh ball(double radius) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < 2; ++level) {
    TriangleMesh finer;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3& a = mesh.corner(t, 0);
      const Vec3& b = mesh.corner(t, 1);
      const Vec3& c = mesh.corner(t, 2);
      const auto i = static_cast<std::int32_t>(finer.vertices.size());
      for (const Vec3& p : {a, b, c, Vec3(a + b), Vec3(b + c), Vec3(c + a)})
        finer.vertices.push_back(p.normalized());
      finer.triangles.insert(
          finer.triangles.end(),
          {{i, i + 3, i + 5}, {i + 3, i + 1, i + 4}, {i + 5, i + 4, i + 2}, {i + 3, i + 4, i + 5}});
    }
    mesh = std::move(finer);
  }
  weld(mesh, 1e-9);
  transform(mesh, Pose::Identity(), radius);
  return mesh;
}

/// Collects nodes and meshes; then makes the scene that owns them.
class GlbScene {
 public:
  int add_mesh(const TriangleMesh& mesh, const std::string& name, Look look) {
    meshes_.push_back(make_mesh(mesh, name, look));
    return static_cast<int>(meshes_.size()) - 1;
  }
  void add_node(const std::string& name, const Pose& X_ON, int mesh) {
    auto* node = new aiNode(name);
    node->mTransformation = to_assimp(X_ON);
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{static_cast<unsigned>(mesh)};
    nodes_.push_back(node);
  }
  void add(const TriangleMesh& mesh, const std::string& name, const Pose& X_ON, Look look) {
    if (!mesh.empty()) add_node(name, X_ON, add_mesh(mesh, name, look));
  }
  std::unique_ptr<aiScene> finish() {
    auto scene = std::make_unique<aiScene>();
    scene->mMaterials = new aiMaterial*[look_count];
    scene->mNumMaterials = look_count;
    for (unsigned i = 0; i < look_count; ++i) scene->mMaterials[i] = make_material(kColors[i]);
    scene->mNumMeshes = static_cast<unsigned>(meshes_.size());
    scene->mMeshes = new aiMesh*[meshes_.size()];
    std::copy(meshes_.begin(), meshes_.end(), scene->mMeshes);
    scene->mRootNode = new aiNode("object_frame");
    scene->mRootNode->mTransformation =
        to_assimp(Pose(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitX())));
    scene->mRootNode->addChildren(static_cast<unsigned>(nodes_.size()), nodes_.data());
    return scene;
  }

 private:
  std::vector<aiMesh*> meshes_;
  std::vector<aiNode*> nodes_;
};

VecX joints_of(const HandModel& hand, const NamedValues& values) {
  VecX joints = joint_values(hand, hand.rest_posture());
  for (const auto& [name, value] : values) {
    const int j = hand.find_joint(name);
    if (j < 0) fail("the hand \"{}\" has no joint \"{}\"", hand.name, name);
    joints[j] = value;
  }
  return joints;
}

}  // namespace

std::string grasp_glb(const Scene& scene, const Grasp& grasp, GraspPhase phase) {
  if (!scene.hand || !scene.object) throw std::logic_error("grasp_glb: a scene without hand or object");
  const bool closed = phase == GraspPhase::grasp;
  const HandModel& hand = *scene.hand;
  const VecX joints = joints_of(hand, closed ? grasp.grasp_joints : grasp.pregrasp_joints);
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joints, closed ? grasp.X_OH : grasp.X_OH_pregrasp, X_OL);
  GlbScene glb;
  for (std::size_t i = 0; i < hand.links.size(); ++i)
    glb.add(hand.links[i].mesh, "link:" + hand.links[i].name, X_OL[i], hand_look);
  glb.add(scene.object->mesh, "object:" + scene.object->name, Pose::Identity(), object_look);
  for (const Obstacle& obstacle : scene.obstacles)
    glb.add(obstacle.model->mesh, "obstacle:" + obstacle.model->name, obstacle.X_OB, obstacle_look);
  if (closed && !grasp.contacts.empty()) {
    const int marker = glb.add_mesh(ball(kBallRadius), "contact", contact_look);
    int number = 0;
    for (const GraspContact& contact : grasp.contacts)
      glb.add_node(fmt::format("contact:{}", ++number),
                   make_pose(Eigen::Quaterniond::Identity(), contact.point.p_OC), marker);
  }
  const std::unique_ptr<aiScene> whole = glb.finish();
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(whole.get(), "glb2", aiProcess_JoinIdenticalVertices);
  if (blob == nullptr) throw std::runtime_error(std::string("glTF export: ") + exporter.GetErrorString());
  return {static_cast<const char*>(blob->data), blob->size};
}

void save_grasp_glb(const Scene& scene, const Grasp& grasp, const std::filesystem::path& path,
                    GraspPhase phase) {
  write_file_atomically(path, grasp_glb(scene, grasp, phase));
}

}  // namespace eigengrasp
