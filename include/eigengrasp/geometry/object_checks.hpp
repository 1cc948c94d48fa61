// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/geometry/mass_properties.hpp"

namespace eigengrasp {

/// What a user may want to know of an object before a hand grasps it; empty for a usual one. One sentence
/// each:
/// - the longest side of the box is above five times or below a twentieth of hand_size [m] (the length of the
///   hand, about 0.2), with the units (mm, cm, in) that would make it 1 to 60 cm;
/// - the mesh is not watertight, or is inside out or without volume: the surface's centre of mass is used.
/// @pre hand_size > 0; the mesh of the report is not empty and in metres
std::vector<std::string> size_warnings(const MeshReport& report, double hand_size);

}  // namespace eigengrasp
