// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/grasp/contact_finder.hpp"

#include <Eigen/Eigenvalues>

#include "eigengrasp/contact/material.hpp"
#include "eigengrasp/geometry/curvature.hpp"
#include "eigengrasp/geometry/mesh_motion.hpp"
#include "grasp/contact_patches.hpp"

namespace eigengrasp {

namespace {

/// Torsion length of a soft link at a contact point: relative curvature of the two surfaces, felt through the
/// pad.
double torsion_length(const CollisionModel& model, std::size_t link, const Pose& X_OL, const ContactPoint& c,
                      double radius) {
  const HandLink& l = model.scene().hand->links[link];
  const auto [t1, t2] = contact_tangents(c.n_OC);
  const Mat3 R_LO = X_OL.linear().transpose();
  const ClosestPoint on_link = model.surfaces().links[link].bvh.closest_point(X_OL.inverse() * c.p_OC);
  const Eigen::Matrix2d K_hand = estimate_curvature(model.surfaces().links[link].bvh, on_link.point,
                                                    R_LO * c.n_OC, R_LO * t1, R_LO * t2, radius);
  const Eigen::Matrix2d K_object =
      estimate_curvature(model.scene().object->bvh, c.p_OC, -c.n_OC, t1, t2, radius);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(K_hand + K_object, Eigen::EigenvaluesOnly);
  return soft_finger_torsion_length(solver.eigenvalues()[0], solver.eigenvalues()[1],
                                    *l.material.youngs_modulus);
}

}  // namespace

std::vector<GraspContact> find_contacts(const CollisionModel& model, const std::vector<Pose>& X_OL,
                                        const ContactOptions& options, const HandProximity* known) {
  const Scene& scene = model.scene();
  std::vector<GraspContact> contacts;
  const SeparationFront nothing_known;
  int patch_number = 0;
  for (std::size_t i = 0; i < X_OL.size(); ++i) {
    const auto& surface = model.surfaces().links[i];
    if (surface.empty()) continue;
    if (!model.object_field().empty() &&
        certain_distance(model.object_field(), X_OL[i] * surface.bound.center) >
            surface.bound.radius + options.threshold)
      continue;
    if (surface.cover.keeps_away(model.object_field(), X_OL[i], options.threshold)) continue;
    const HandLink& link = scene.hand->links[i];
    const bool has_front = known != nullptr && i < known->object_fronts.size();
    const auto touches =
        find_touch_points(scene.object->bvh, surface.bvh, X_OL[i], options.threshold, model.object_field(),
                          has_front ? known->object_fronts[i] : nothing_known);
    for (const auto& patch : make_patches(touches, options.merge)) {
      for (const TouchPoint& t : patch) {
        ContactPoint c{t.p, t.n, contact_friction(link.material, scene.object_material), 0.0};
        if (link.material.youngs_modulus)
          c.torsion_length = torsion_length(model, i, X_OL[i], c, options.curvature_radius);
        contacts.push_back({link.name, patch_number, c});
      }
      ++patch_number;
    }
  }
  return contacts;
}

}  // namespace eigengrasp
