// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/database/grasp_store.hpp"
#include "eigengrasp/report/grasp_file.hpp"

namespace eigengrasp {

/// Adds the grasps of a file that 'eigengrasp plan' wrote, with their hand and object where those are
/// missing. They stand behind the grasps that are there; the same file again adds them again. The object's
/// geometry and the hand have to be where the file says. @returns how many grasps were added
/// @throws Error where the geometry is missing or has changed, or where the store has another object or hand
/// of that name
std::size_t import_grasp_file(const GraspFile& file, GraspStore& store);

}  // namespace eigengrasp
