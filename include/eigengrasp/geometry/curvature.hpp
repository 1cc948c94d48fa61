// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/mesh_bvh.hpp"

namespace eigengrasp {

/// Curvature of a surface about a point: second fundamental form in the tangent directions (t1, t2), i.e. the
/// height of the surface below the tangent plane is (u, v) K (u, v)^T / 2. Positive where it bends away from
/// the outward normal n (a ball of radius r has K = I / r). Least squares over two rings of probes at radius
/// and radius / 2 [m], so that it depends on the shape at that size and not on the tessellation; a flat face
/// has 0. Probes that lie beyond an edge, more than the radius below the plane, count with that depth. Cost:
/// 2-4 us.
/// @pre p lies on the surface; n, t1, t2 orthonormal.
Eigen::Matrix2d estimate_curvature(const MeshBvh& bvh, const Vec3& p, const Vec3& n, const Vec3& t1,
                                   const Vec3& t2, double radius);

}  // namespace eigengrasp
