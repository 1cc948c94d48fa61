// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/modeling/solid.hpp"

namespace eigengrasp::modeling {

/// a or b.
Solid unite(const Solid& a, const Solid& b);
/// Any of the solids. @pre at least one.
Solid unite(const std::vector<Solid>& solids);
/// a or b with a fillet; `blend` [m] > 0 is the difference of the distances below which both matter (a right
/// angle gets a fillet of about that radius).
Solid smooth_unite(const Solid& a, const Solid& b, double blend);
/// a without b.
Solid subtract(const Solid& a, const Solid& b);
/// a without b, the rim rounded; blend as in smooth_unite.
Solid smooth_subtract(const Solid& a, const Solid& b, double blend);
/// a and b.
Solid intersect(const Solid& a, const Solid& b);
/// a and b, the rim rounded; blend as in smooth_unite.
Solid smooth_intersect(const Solid& a, const Solid& b, double blend);

/// The solid of frame S seen in frame P: p_P = X_PS * p_S.
Solid move(const Solid& solid, const Pose& X_PS);
/// The solid moved by `offset` [m].
Solid move(const Solid& solid, const Vec3& offset);
/// The mirror image at the plane where the coordinate `axis` in {0, 1, 2} is zero.
Solid mirror(const Solid& solid, int axis);
/// Everything within `distance` [m] of the solid; negative shrinks. Rounds convex edges where positive.
Solid inflate(const Solid& solid, double distance);

/// The half space (p - point) . outward_normal <= 0, within the given box; for cuts by intersect and
/// subtract.
Solid half_space(const Vec3& point, const Vec3& outward_normal, const Box& box);

}  // namespace eigengrasp::modeling
