// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/geometry/mass_properties.hpp"

namespace eigengrasp {

/// What a user may want to know of an object before a hand grasps it; empty for a usual one. One sentence
/// each:
/// - the longest side of the box is above ten times or below a twentieth of hand_size [m] (the hand's length,
///   about 0.2), with the units (mm, cm, in, or m for a small object) that would make it 1 to 60 cm, the
///   nearest to half the hand first;
/// - the mesh is not watertight, or is watertight but turned inside out: the surface's centre of mass is
/// used.
/// @pre hand_size > 0; the report is of a mesh in metres, read with unit scale.
std::vector<std::string> size_warnings(const MeshReport& report, double hand_size);

}  // namespace eigengrasp
