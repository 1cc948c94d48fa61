// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "eigengrasp/geometry/triangle_mesh.hpp"

struct aiMesh;
struct aiNode;

namespace eigengrasp {

enum class GlbLook : unsigned { hand, object, obstacle, contact };

/// Collects nodes and meshes of a binary glTF 2.0; nodes stand below one root.
class GlbScene {
 public:
  GlbScene() = default;
  ~GlbScene();
  GlbScene(const GlbScene&) = delete;
  GlbScene& operator=(const GlbScene&) = delete;

  /// Returns its number. @pre the mesh is not empty
  int add_mesh(const TriangleMesh& mesh, const std::string& name, GlbLook look);
  /// @param X_ON pose below the root
  void add_node(const std::string& name, const Pose& X_ON, int mesh);
  /// Both; nothing for an empty mesh.
  void add(const TriangleMesh& mesh, const std::string& name, const Pose& X_ON, GlbLook look);

  /// The file. The scene is empty afterwards. @param X_root pose of the root in glTF's frame
  std::string bytes(const std::string& root, const Pose& X_root);

 private:
  std::vector<aiMesh*> meshes_;
  std::vector<aiNode*> nodes_;
};

}  // namespace eigengrasp
