// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// The factor that brings an object to a size that hands can grasp: the middle side of its box becomes 70 mm,
/// but the longest no more than 250 mm. A box that is flat in two directions goes by its longest side.
/// @pre the box is not empty and has a length
double graspable_rescale(const Box& box);

/// Whether an object of known size can be grasped as it is: the middle side of its box is 10 to 150 mm, and
/// the longest 30 to 400 mm.
bool is_graspable(const Box& box);

/// The approximate radius of the Columbia Grasp Database [m]: mean plus two standard deviations of the
/// distance from the center to the surface, over the surface's area. Integrated over pieces of at most a
/// fiftieth of the box's diagonal, which errs by less than 0.1 %. @pre some triangle has an area
double approximate_radius(const TriangleMesh& mesh, const Vec3& center);

}  // namespace eigengrasp
