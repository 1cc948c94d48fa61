// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// What check_hand says about surfaces: collisions, contacts, sizes, open meshes.
#include <algorithm>

#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "model_io/hand_findings.hpp"

namespace eigengrasp {

using Severity = HandFinding::Severity;

namespace {

constexpr double contact_tolerance = 1e-3;  ///< [m] a virtual contact may be off its surface
constexpr double probe_step = 1e-3;         ///< [m] to either side of a surface, to see which is inside
constexpr double largest_hand = 1.0;        ///< [m]
constexpr double smallest_hand = 0.03;      ///< [m]
constexpr double heaviest_link = 5.0;       ///< [kg]

/// How deep the deepest vertex of a lies inside b [m].
double depth_inside(const TriangleMesh& a, const MeshBvh& b, const Pose& X_BA) {
  double deepest = 0.0;
  for (const Vec3& v : a.vertices) deepest = std::max(deepest, -b.signed_distance(X_BA * v));
  return deepest;
}

std::string shown_vector(const Vec3& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

void check_contact(const HandModel& hand, const HandSurfaces& surfaces, std::size_t index,
                   Findings& findings) {
  const VirtualContact& contact = hand.virtual_contacts[index];
  const auto l = static_cast<std::size_t>(contact.link);
  const std::string what = fmt::format("virtual contact {} on {} at {}", index + 1, hand.links[l].name,
                                       shown_vector(contact.p_LC));
  const MeshBvh& surface = surfaces.links[l];
  if (surface.empty()) {
    findings.add(Severity::error, "{}: the link has no surface; put the contact on a link that has one",
                 what);
    return;
  }
  const ClosestPoint nearest = surface.closest_point(contact.p_LC);
  if (nearest.distance > contact_tolerance) {
    findings.add(Severity::warning, "{}: is {:.1f} mm off the surface; move it to {}", what,
                 1e3 * nearest.distance, shown_vector(nearest.point));
  }
  if (!surfaces.solid[l]) return;
  const bool front_inside = surface.contains(nearest.point + probe_step * contact.n_LC);
  const bool back_inside = surface.contains(nearest.point - probe_step * contact.n_LC);
  if (front_inside && !back_inside) {
    findings.add(Severity::warning, "{}: its normal {} points into the link; turn it round", what,
                 shown_vector(contact.n_LC));
  }
}

}  // namespace

HandSurfaces prepare_surfaces(const HandModel& hand) {
  HandSurfaces surfaces;
  for (const HandLink& link : hand.links) {
    surfaces.links.emplace_back(link.mesh);
    surfaces.solid.push_back(!link.mesh.empty() && inspect_mesh(link.mesh).solid());
  }
  compute_link_poses(hand, joint_values(hand, hand.rest_posture()), Pose::Identity(), surfaces.X_HL);
  return surfaces;
}

void check_meshes(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings) {
  for (std::size_t i = 0; i < hand.links.size(); ++i) {
    const HandLink& link = hand.links[i];
    if (link.mesh.empty() || surfaces.solid[i]) continue;
    const MeshReport report = inspect_mesh(link.mesh);
    if (report.watertight) {
      findings.add(Severity::warning,
                   "link {}: its mesh is inside out (volume {:.3g} m^3); turn its triangles "
                   "round",
                   link.name, report.volume);
    } else {
      findings.add(
          Severity::note,
          "link {}: its mesh is not closed ({} open edges, {} edges of more than two triangles); close it, "
          "so that inside and outside are known",
          link.name, report.boundary_edges, report.non_manifold_edges);
    }
  }
}

void check_sizes(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings) {
  Box box;
  for (std::size_t i = 0; i < hand.links.size(); ++i)
    for (const Vec3& v : hand.links[i].mesh.vertices) box.add(surfaces.X_HL[i] * v);
  if (box.empty()) {
    findings.add(Severity::error,
                 "no link has a surface, so nothing can touch; give the links <collision> meshes");
  } else if (box.size().maxCoeff() > largest_hand) {
    findings.add(Severity::warning,
                 "the hand is {:.3g} m large, expected less than {:.0f} m; did you mean mm? "
                 "Scale its meshes, joints and contacts",
                 box.size().maxCoeff(), largest_hand);
  } else if (box.size().maxCoeff() < smallest_hand) {
    findings.add(Severity::warning,
                 "the hand is {:.3g} mm large, expected more than {:.0f} mm; is it scaled from mm "
                 "to m twice? Scale its meshes, joints and contacts",
                 1e3 * box.size().maxCoeff(), 1e3 * smallest_hand);
  }
  for (const HandLink& link : hand.links) {
    if (link.mass > heaviest_link) {
      findings.add(Severity::warning,
                   "link {}: its mass is {:.4g} kg, expected less than {:.0f} kg; did you mean g? "
                   "Divide it by 1000",
                   link.name, link.mass, heaviest_link);
    } else if (link.mass < 0.0) {
      findings.add(Severity::warning, "link {}: its mass is {:.4g} kg, expected a positive number", link.name,
                   link.mass);
    }
  }
}

void check_rest_collisions(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings) {
  for (const auto& [a, b] : hand.collision_pairs) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const Pose X_AB = surfaces.X_HL[i].inverse() * surfaces.X_HL[j];
    if (!intersects(surfaces.links[i], surfaces.links[j], X_AB)) continue;
    double depth = 0.0;
    if (surfaces.solid[i]) depth = depth_inside(hand.links[j].mesh, surfaces.links[i], X_AB);
    if (surfaces.solid[j]) {
      depth = std::max(depth, depth_inside(hand.links[i].mesh, surfaces.links[j], X_AB.inverse()));
    }
    findings.add(
        Severity::error,
        "the links {} and {} collide in the rest posture, {:.1f} mm deep, so no posture near it is free; "
        "choose another rest posture, mend their meshes, or add [{}, {}] to ignore_collisions",
        hand.links[i].name, hand.links[j].name, 1e3 * depth, hand.links[i].name, hand.links[j].name);
  }
}

void check_contacts(const HandModel& hand, const HandSurfaces& surfaces, Findings& findings) {
  if (hand.virtual_contacts.empty()) {
    findings.add(Severity::error,
                 "the hand has no virtual contacts, so a planner does not know where to touch; "
                 "add some to virtual_contacts, on the inner surfaces of palm and fingers");
  }
  for (std::size_t i = 0; i < hand.virtual_contacts.size(); ++i) check_contact(hand, surfaces, i, findings);
}

}  // namespace eigengrasp
