// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/shape/zernike_moments.hpp"

namespace eigengrasp {

/// From sums over a closed surface to integrals over what it encloses. The cone from the origin over a flat
/// piece of surface with area vector a and points p has the integral
///   (a . p) * (mean over the piece of C Z),   (C Z)(p) = integral over t in [0, 1] of t^2 Z(t p),
/// and C Z_nlm is a sum of Z_klm, k <= n: a triangular matrix for each l, with a norm of at most 2.
/// @param sums of (a . p) Z_nlm over the surface @returns sums of (a . p) C Z_nlm
ZernikeMoments apply_cone_operator(const ZernikeMoments& sums);

}  // namespace eigengrasp
