// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "glb_scene.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "corner_normals.hpp"

namespace eigengrasp {

namespace {

constexpr double kCreaseAngle = 40.0 * std::numbers::pi / 180.0;

constexpr unsigned look_count = 4;

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
aiMesh* make_mesh(const TriangleMesh& mesh, const std::string& name, GlbLook look) {
  auto* part = new aiMesh;
  part->mName = aiString(name);
  part->mMaterialIndex = static_cast<unsigned>(look);
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

}  // namespace

GlbScene::~GlbScene() {
  for (aiMesh* mesh : meshes_) delete mesh;
  for (aiNode* node : nodes_) delete node;
}

int GlbScene::add_mesh(const TriangleMesh& mesh, const std::string& name, GlbLook look) {
  meshes_.push_back(make_mesh(mesh, name, look));
  return static_cast<int>(meshes_.size()) - 1;
}

void GlbScene::add_node(const std::string& name, const Pose& X_ON, int mesh) {
  auto* node = new aiNode(name);
  node->mTransformation = to_assimp(X_ON);
  node->mNumMeshes = 1;
  node->mMeshes = new unsigned[1]{static_cast<unsigned>(mesh)};
  nodes_.push_back(node);
}

void GlbScene::add(const TriangleMesh& mesh, const std::string& name, const Pose& X_ON, GlbLook look) {
  if (!mesh.empty()) add_node(name, X_ON, add_mesh(mesh, name, look));
}

std::string GlbScene::bytes(const std::string& root, const Pose& X_root) {
  aiScene scene;
  scene.mMaterials = new aiMaterial*[look_count];
  scene.mNumMaterials = look_count;
  for (unsigned i = 0; i < look_count; ++i) scene.mMaterials[i] = make_material(kColors[i]);
  scene.mNumMeshes = static_cast<unsigned>(meshes_.size());
  scene.mMeshes = new aiMesh*[meshes_.size()];
  std::copy(meshes_.begin(), meshes_.end(), scene.mMeshes);
  meshes_.clear();
  scene.mRootNode = new aiNode(root);
  scene.mRootNode->mTransformation = to_assimp(X_root);
  scene.mRootNode->addChildren(static_cast<unsigned>(nodes_.size()), nodes_.data());
  nodes_.clear();
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, "glb2", aiProcess_JoinIdenticalVertices);
  if (blob == nullptr) throw std::runtime_error(std::string("glTF export: ") + exporter.GetErrorString());
  return {static_cast<const char*>(blob->data), blob->size};
}

}  // namespace eigengrasp
