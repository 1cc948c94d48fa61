// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// The plane normal . p = offset.
struct MirrorPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit, away from the sensor
  double offset = 0.0;          ///< [m]
  double conflicts = 0.0;       ///< share of the mirrored points in space that is seen to be free
  double support = 0.0;         ///< share of the mirrored points on a surface that is seen

  Vec3 mirrored(const Vec3& p) const { return p - 2.0 * (normal.dot(p) - offset) * normal; }
};

/// Most things that hands grasp are mirror images of themselves: the plane behind which the unseen side is
/// the image of the seen one (as in Bohg et al., "Mind the gap", ICRA 2011, but for any direction of the
/// plane). Of planes up to 75 degrees from facing the sensor, those are taken whose mirrored points do not
/// lie in space seen to be free; of them the one that makes the object thin and lays many points on what is
/// seen.
/// @param up where it is known: planes are then upright or level, as those of things that stand on a table
/// are
/// @param points of the surface seen; 400 of them are used  @param outside as DepthView::outside, of all
/// views
/// @param direction unit, from the sensor into the scene  @param tolerance [m]
/// @return none where all planes are in conflict with more than a tenth of the points. Cost: 50-100 ms.
std::optional<MirrorPlane> find_mirror_plane(const std::vector<Vec3>& points,
                                             const std::function<double(const Vec3&)>& outside,
                                             const Vec3& direction, double tolerance,
                                             const std::optional<Vec3>& up = {});

}  // namespace eigengrasp
