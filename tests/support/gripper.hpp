// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/grasp/scene.hpp"

namespace eigengrasp::testing {

/// A box of the given size about a centre, triangles counter-clockwise from outside.
inline TriangleMesh box_mesh(const Vec3& size, const Vec3& center = Vec3::Zero()) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(center + 0.5 * Vec3((i & 1) != 0 ? size.x() : -size.x(),
                                                (i & 2) != 0 ? size.y() : -size.y(),
                                                (i & 4) != 0 ? size.z() : -size.z()));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// A ball about the origin of longitude and latitude triangles.
inline TriangleMesh ball_mesh(double radius, int rings = 48) {
  TriangleMesh mesh;
  const int sides = 2 * rings;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const double a = std::numbers::pi * r / rings;
      const double b = 2.0 * std::numbers::pi * s / sides;
      mesh.vertices.emplace_back(radius *
                                 Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const int next = (s + 1) % sides;
      const int p = r * sides;
      const int q = p + sides;
      if (r > 0) mesh.triangles.push_back({p + s, q + s, p + next});
      if (r + 1 < rings) mesh.triangles.push_back({p + next, q + s, q + next});
    }
  return mesh;
}

/// A palm with two fingers of two links each; the fingers close about y towards each other along x.
inline std::shared_ptr<HandModel> two_finger_hand() {
  auto hand = std::make_shared<HandModel>();
  hand->name = "gripper";
  hand->title = "Two-finger gripper";
  hand->source = "gripper/hand.yaml";
  hand->links.push_back({"palm", box_mesh({0.12, 0.04, 0.03}), {}, 0.0});
  for (int finger = 0; finger < 2; ++finger) {
    const std::string name = finger == 0 ? "left" : "right";
    const double sign = finger == 0 ? -1.0 : 1.0;
    HandDof dof{name, DofType::breakaway, -0.2, 1.2, 0.0, 1.0};
    for (int k = 0; k < 2; ++k) {
      HandJoint joint;
      joint.name = name + (k == 0 ? "_proximal" : "_distal");
      joint.parent_link = k == 0 ? 0 : hand->n_links() - 1;
      joint.X_PJ.translation() = k == 0 ? Vec3(0.05 * sign, 0.0, 0.015) : Vec3(0.0, 0.0, 0.05);
      joint.axis_J = Vec3(0.0, -sign, 0.0);
      joint.dof = finger;
      joint.ratio = k == 0 ? 1.0 : 0.5;
      joint.min = -0.2;
      joint.max = 1.2;
      hand->joints.push_back(joint);
      hand->links.push_back({joint.name, box_mesh({0.015, 0.02, 0.048}, {0.0, 0.0, 0.025}), {}, 0.0});
    }
    hand->virtual_contacts.push_back(
        {hand->n_links() - 1, Vec3(-0.0075 * sign, 0.0, 0.03), Vec3(-sign, 0.0, 0.0)});
    hand->dofs.push_back(dof);
  }
  hand->approach_point_H = Vec3(0.0, 0.0, 0.02);
  Eigengrasp close{"close", VecX::Ones(2), -0.2, 1.4};
  Eigengrasp sway{"sway", (VecX(2) << 1.0, -1.0).finished(), -0.5, 0.5};
  hand->eigengrasps = EigengraspSpace(VecX::Constant(2, 0.1), {close, sway});
  return hand;
}

/// The hand around a ball of radius 30 mm, with a contact at each side.
inline Scene ball_scene() {
  Scene scene;
  scene.hand = two_finger_hand();
  auto ball = make_object("ball", ball_mesh(0.03));
  ball.source = "objects/ball.obj";
  scene.object = std::make_shared<const ObjectModel>(std::move(ball));
  return scene;
}

inline Grasp ball_grasp() {
  Grasp grasp;
  grasp.hand = "gripper";
  grasp.object = "ball";
  grasp.X_OH.translation() = Vec3(0.0, 0.0, -0.075);
  grasp.X_OH_pregrasp = make_pose({0.9, 0.1, -0.2, 0.3}, {0.01, -0.02, -0.1});
  for (const char* name : {"left_proximal", "left_distal", "right_proximal", "right_distal"}) {
    grasp.pregrasp_joints.emplace_back(name, 0.1);
    grasp.grasp_joints.emplace_back(name, 1.0 / 3.0);
  }
  grasp.pregrasp_dofs = VecX::Constant(2, 0.1);
  grasp.grasp_dofs = VecX::Constant(2, 1.0 / 3.0);
  grasp.amplitudes = (VecX(2) << std::numbers::pi / 7.0, -0.125).finished();
  for (int side = 0; side < 2; ++side) {
    GraspContact contact;
    const double sign = side == 0 ? -1.0 : 1.0;
    contact.link = side == 0 ? "left_distal" : "right_distal";
    contact.patch = side;
    contact.point = {Vec3(0.03 * sign, 0.0, 0.0), Vec3(-sign, 0.0, 0.0), 0.4, 0.002};
    grasp.contacts.push_back(contact);
  }
  grasp.energy = 0.1 + 0.2;
  grasp.epsilon = 0.2134567890123456;
  grasp.volume = 1e-3 / 3.0;
  grasp.form_closure = true;
  grasp.max_penetration = 1.25e-4;
  grasp.provenance = {"annealing/contact", 18446744073709551615ULL, "0123456789abcdef", "0.1.0"};
  return grasp;
}

}  // namespace eigengrasp::testing
