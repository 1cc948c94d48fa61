// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/shape/zernike_moments.hpp"

namespace eigengrasp {

/// Moments of exp(-d^2 / (2 width^2)), d the distance to the surface over the ball's radius, times a window
/// that falls from 1 to 0 between 0.8 and 1 radii. Summed over a grid of 40^3 cells. @pre width >= 0.05
ZernikeMoments compute_thick_surface_moments(const TriangleMesh& mesh, const ShapeBall& ball, double width,
                                             int order);

/// Moments of the inside by the generalised winding number, on the same grid; cells that the surface passes
/// count by the share of them that is inside. All 0 where no cell's centre is inside. @pre the mesh lies in
/// the ball
ZernikeMoments compute_filled_moments(const TriangleMesh& mesh, const ShapeBall& ball, int order);

}  // namespace eigengrasp
