// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <memory>

#include "eigengrasp/grasp/collision_model.hpp"
#include "support/gripper.hpp"
#include "support/solid_shapes.hpp"

namespace eigengrasp::testing {

/// A palm below z = 0 and two fingers that slide towards each other along x; one degree of freedom drives
/// both. At value q their flat inner faces (20 x 60 mm) are at x = -+(45 mm - q).
inline std::shared_ptr<HandModel> parallel_gripper(DofType type = DofType::rigid, double travel = 0.044) {
  auto hand = std::make_shared<HandModel>();
  hand->name = "parallel gripper";
  hand->links.push_back({"palm", box_mesh({0.12, 0.04, 0.02}, {0.0, 0.0, -0.01}), {}, 0.0});
  hand->dofs.push_back({"grip", type, 0.0, travel, 0.0, 0.1});
  for (const double side : {-1.0, 1.0}) {
    HandJoint joint;
    joint.name = side < 0.0 ? "left" : "right";
    joint.type = JointType::prismatic;
    joint.X_PJ.translation() = Vec3(0.045 * side, 0.0, 0.0);
    joint.axis_J = Vec3(-side, 0.0, 0.0);
    joint.dof = 0;
    joint.max = travel;
    hand->joints.push_back(joint);
    hand->links.push_back({joint.name, box_mesh({0.01, 0.02, 0.06}, {0.005 * side, 0.0, 0.031}), {}, 0.0});
    hand->virtual_contacts.push_back({hand->n_links() - 1, Vec3(0.0, 0.0, 0.04), Vec3(-side, 0.0, 0.0)});
  }
  hand->approach_point_H = Vec3(0.0, 0.0, 0.03);
  hand->eigengrasps =
      EigengraspSpace::identity(hand->rest_posture(), hand->dof_min(), hand->dof_max(), hand->dof_names());
  set_collision_pairs(*hand, {});
  check_invariants(*hand);
  return hand;
}

/// A hand of one link without joints.
inline std::shared_ptr<HandModel> pad(TriangleMesh mesh, const Material& material = {}) {
  auto hand = std::make_shared<HandModel>();
  hand->name = "pad";
  hand->links.push_back({"pad", std::move(mesh), material, 0.0});
  return hand;
}

inline std::shared_ptr<const ObjectModel> solid(TriangleMesh mesh, const Vec3& at = Vec3::Zero()) {
  Pose X = Pose::Identity();
  X.translation() = at;
  transform(mesh, X);
  return std::make_shared<const ObjectModel>(make_object("solid", std::move(mesh)));
}

inline Scene scene_of(std::shared_ptr<const HandModel> hand, std::shared_ptr<const ObjectModel> object,
                      std::vector<Obstacle> obstacles = {}) {
  return {std::move(hand), std::move(object), std::move(obstacles), {}};
}

inline CollisionModel exact_model(Scene scene) {
  CollisionModel::Options options;
  options.fast = false;
  return CollisionModel(std::move(scene), options);
}

inline Pose at(double x, double y, double z) {
  Pose X = Pose::Identity();
  X.translation() = Vec3(x, y, z);
  return X;
}

}  // namespace eigengrasp::testing
