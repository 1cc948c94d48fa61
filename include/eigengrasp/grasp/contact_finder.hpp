// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/grasp/collision_model.hpp"
#include "eigengrasp/grasp/grasp.hpp"
#include "eigengrasp/grasp/hand_proximity.hpp"

namespace eigengrasp {

struct ContactOptions {
  double threshold = 0.0002;         ///< surfaces nearer than this touch [m]
  double merge = 0.003;              ///< points nearer than this are one [m]
  double curvature_radius = 0.0035;  ///< size at which soft fingers feel the curvature [m]
};

/// Where the links of the hand touch the object. Each touching region is a patch: its points are the corners
/// of the region's perimeter (the convex hull of the touching points in the plane of the contact), or one
/// point where the region is smaller than options.merge. Friction after the materials; soft links get their
/// torsion length from the curvature of both surfaces. Deterministic order: by link, then patch. @param X_OL
/// poses of the links (n_links). Cost: 10-200 us a touching link.
/// @param known of this pose: the same contacts, to the last bit, with less search
std::vector<GraspContact> find_contacts(const CollisionModel& model, const std::vector<Pose>& X_OL,
                                        const ContactOptions& options = {},
                                        const HandProximity* known = nullptr);

/// One touching pair of points with the direction in which the hand presses.
struct TouchPoint {
  Vec3 p;             ///< on the object [m]
  Vec3 n;             ///< unit, out of the first surface (hand), into the second
  double distance;    ///< [m]
  int triangle = -1;  ///< of the first surface; points of one triangle with one normal belong together
};

/// Touching points of a posed surface (hand side) and a solid, in the order of the link's triangles. In the
/// frame of the solid. @param field of the solid, or empty @param front of the two, whatever it knows: both
/// only spare search
std::vector<TouchPoint> find_touch_points(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL,
                                          double threshold, const DistanceField& field = {},
                                          const SeparationFront& front = {});

/// Those of one pair of triangles, a's of the solid and b's of the link.
std::vector<TouchPoint> find_touch_points(const MeshBvh& solid, const MeshBvh& link, const Pose& X_SL,
                                          double threshold, const PairHint& triangles);

}  // namespace eigengrasp
