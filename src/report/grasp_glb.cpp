// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/report/grasp_glb.hpp"
#include "eigengrasp/grasp/named_joints.hpp"

#include <numbers>
#include <stdexcept>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "glb_scene.hpp"

namespace eigengrasp {

namespace {

constexpr double kBallRadius = 0.003;  // of a contact [m]
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

}  // namespace

std::string grasp_glb(const Scene& scene, const Grasp& grasp, GraspPhase phase) {
  if (!scene.hand || !scene.object) throw std::logic_error("grasp_glb: a scene without hand or object");
  const bool closed = phase == GraspPhase::grasp;
  const HandModel& hand = *scene.hand;
  const VecX joints = joints_by_name(hand, closed ? grasp.grasp_joints : grasp.pregrasp_joints);
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joints, closed ? grasp.X_OH : grasp.X_OH_pregrasp, X_OL);
  GlbScene glb;
  for (std::size_t i = 0; i < hand.links.size(); ++i)
    glb.add(hand.links[i].mesh, "link:" + hand.links[i].name, X_OL[i], GlbLook::hand);
  glb.add(scene.object->mesh, "object:" + scene.object->name, Pose::Identity(), GlbLook::object);
  for (const Obstacle& obstacle : scene.obstacles)
    glb.add(obstacle.model->mesh, "obstacle:" + obstacle.model->name, obstacle.X_OB, GlbLook::obstacle);
  if (closed && !grasp.contacts.empty()) {
    const int marker = glb.add_mesh(ball(kBallRadius), "contact", GlbLook::contact);
    int number = 0;
    for (const GraspContact& contact : grasp.contacts)
      glb.add_node(fmt::format("contact:{}", ++number),
                   make_pose(Eigen::Quaterniond::Identity(), contact.point.p_OC), marker);
  }
  return glb.bytes("object_frame", Pose(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitX())));
}

void save_grasp_glb(const Scene& scene, const Grasp& grasp, const std::filesystem::path& path,
                    GraspPhase phase) {
  write_file_atomically(path, grasp_glb(scene, grasp, phase));
}

}  // namespace eigengrasp
