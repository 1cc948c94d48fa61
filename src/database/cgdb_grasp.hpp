// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/grasp/grasp.hpp"

namespace eigengrasp {

/// A grasp as the Columbia Grasp Database has it. Joints are the hand's degrees of freedom [rad or m] behind
/// a 5, positions x, y, z [mm] and a quaternion w, x, y, z behind a 0, contacts x, y, z [mm] each, all of
/// them in the object's frame at its scale.
struct CgdbGrasp {
  std::vector<double> pregrasp_joints, pregrasp_position, grasp_joints, grasp_position, contacts;
};

CgdbGrasp to_cgdb(const Grasp& grasp);

/// Poses, degrees of freedom and contact positions; what is not in the tables stays as a new Grasp has it.
/// @param where what errors call the grasp @throws Error where an array has another size
Grasp from_cgdb(const CgdbGrasp& row, const std::string& where);

}  // namespace eigengrasp
