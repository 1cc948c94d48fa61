// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <span>
#include <vector>

#include "eigengrasp/contact/contact_point.hpp"
#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// How the contact wrenches are joined: l1: the sum of all normal forces is at most 1 (convex hull of the
/// union); linf: each normal force is at most 1 (hull of the Minkowski sum) (Ferrari and Canny 1992).
enum class WrenchNorm { l1, linf };

/// How a contact's cone enters the wrench space.
enum class ConeModel {
  edges,  ///< an inscribed polytope: options.edges friction directions; soft fingers: 20 points of the
          ///< friction ellipsoid, 1, 5, 8, 5, 1 at latitudes 90, 45, 0, -45, -90 deg (e in millimetres, as
          ///< GraspIt!)
  exact,  ///< the true cone or ellipsoid, by its closed-form support function
};

struct WrenchSpaceOptions {
  WrenchNorm norm = WrenchNorm::l1;
  ConeModel cone = ConeModel::edges;
  int edges = 8;                        ///< friction directions of a point contact, >= 3
  Vec3 torque_origin_O = Vec3::Zero();  ///< torques are about this point of the object frame [m]
  double torque_scale = 1.0;            ///< torques are divided by this length [m], > 0
  double epsilon_min = 1e-6;            ///< form closure means epsilon >= this [-]
  /// Of epsilon where the cone is exact [-], absolute or relative to epsilon, whichever is wider. Each decade
  /// costs the same again. Of no effect on edges, whose epsilon is exact up to rounding.
  double tolerance = 1e-6;
};

struct WrenchSpaceQuality {
  double epsilon =
      0.0;  ///< radius of the largest origin-centred ball inside the wrench space; 0: origin not inside
  bool form_closure = false;  ///< epsilon >= epsilon_min, and above 0
  /// Unit wrench (force, torque over torque_scale) in whose direction the space reaches least far: what the
  /// grasp resists worst is its opposite. Where the origin is not inside, a direction that shows it, or zero.
  Vec6 weakest = Vec6::Zero();
};

/// Wrenches of the cone edges of one contact at unit normal force, torque about the origin and scaled as in
/// the options (force = n + mu (cos t1 + sin t2), edges at equal angles beginning at t1). Appended to out.
void append_edge_wrenches(const ContactPoint& contact, const WrenchSpaceOptions& options,
                          std::vector<Vec6>& out);

/// Epsilon quality of a set of contacts. Expands a polytope from inside towards the facet nearest to the
/// origin (EPA; Zheng 2013) with the support function of the wrench space: no hull of all wrenches is built.
/// Degenerate sets (none, one or two contacts, coplanar, parallel, repeated) give 0 or their true epsilon,
/// never an error. Where the cone is exact the result is an upper bound, at most options.tolerance too high;
/// the work is limited to about a million facets, which only exact cones with tolerances below 1e-9 come
/// near.
/// @pre finite contacts, unit normals, options as their bounds say. Cost: 0.005 ms for 3 contacts, 0.1 ms
/// for 8; exact cones five times that, and up to 100 ms for two soft fingers that oppose each other to
/// tolerance 1e-9. Does not allocate after the first calls of a thread.
WrenchSpaceQuality compute_epsilon(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options);

/// The same for plain wrenches whose L1 wrench space is their convex hull.
WrenchSpaceQuality compute_epsilon(std::span<const Vec6> wrenches, double epsilon_min = 1e-6);

/// How well a search needs to know epsilon.
struct RoughEpsilon {
  double at_least = 0.0;    ///< a smaller one may come out as anything in between
  int most_expansions = 0;  ///< of the polytope; 0: as many as it takes. Each costs about 1 us
};

/// Epsilon of plain wrenches for a search, a tenth of the cost: an upper bound, no better than asked for.
WrenchSpaceQuality estimate_epsilon(std::span<const Vec6> wrenches, double epsilon_min,
                                    const RoughEpsilon& rough);

/// Whether the origin lies inside the wrench space by at least epsilon_min; stops as soon as that is decided,
/// which is several times cheaper than epsilon: about 0.005 ms. Where the cone is exact, an epsilon within
/// epsilon_min / 1000 of epsilon_min may be decided either way.
bool has_form_closure(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options);

/// Volume of the convex hull of the wrenches in six dimensions, to about 1e-8 of its value (a polytope grown
/// to the whole hull; Qhull, joggled by 1e-10, where that takes too many facets); 0 where they are
/// degenerate: flat to 1e-7 of their extent. Prints nothing. Cost: 0.2-5 ms.
double compute_hull_volume(std::span<const Vec6> wrenches);

/// Volume of the wrench space of the contacts, from the edges of their cones whatever options.cone says;
/// linf: of the Minkowski sum, whose corners grow steeply with the contacts: 0, i.e. not computed, for more
/// than most_linf_volume_contacts.
inline constexpr std::size_t most_linf_volume_contacts = 3;
double compute_volume(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options);

}  // namespace eigengrasp
