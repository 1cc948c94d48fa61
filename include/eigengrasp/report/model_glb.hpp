// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/geometry/object_model.hpp"
#include "eigengrasp/kinematics/hand_model.hpp"

namespace eigengrasp {

/// A hand as binary glTF 2.0 [m], to be posed by whoever draws it: one node for each link with geometry,
/// below the root "hand", with the link's name, its mesh in the link frame, at the identity. Axes as they
/// stand: z is not turned to glTF's y.
std::string hand_glb(const HandModel& hand);

/// An object likewise: one node "object" below the root "scene", in the object frame.
std::string object_glb(const ObjectModel& object);

}  // namespace eigengrasp
