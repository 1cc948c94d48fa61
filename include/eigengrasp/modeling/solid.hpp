// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <functional>

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp::modeling {

/// Signed distance [m] of a point [m]: negative inside, zero on the surface, positive outside. It need not be
/// the true distance, but its zero set must be the surface, it must be continuous near it, and its gradient
/// there should have about unit length.
using Distance = std::function<double(const Vec3&)>;

/// A solid: a distance and a box [m] that contains the whole solid. Plain value; copies are independent.
struct Solid {
  Distance distance;
  Box box;

  double operator()(const Vec3& p) const { return distance(p); }
};

/// Gradient of the distance [-] by differences over a tetrahedron of half edge h [m].
Vec3 gradient(const Solid& solid, const Vec3& p, double h = 1e-5);

}  // namespace eigengrasp::modeling
