// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>

#include "eigengrasp/geometry/object_model.hpp"

namespace eigengrasp {

struct ObjectReadOptions {
  /// Of the file: "m", "cm", "mm" or "in". Empty: mm for GraspIt! bodies and Open Inventor or VRML files, m
  /// for all others.
  std::string units = {};
  double scale = 1.0;         ///< the object is made this many times larger
  double later_scale = 1.0;   ///< by which the caller rescales it: a mesh's size is judged after it
  std::string name = {};      ///< empty: the file's name without its ending
  std::string material = {};  ///< empty: what the file says
};

/// Reads an object to grasp: a GraspIt! body (.xml), Open Inventor or VRML (.iv, .wrl), or a mesh file that
/// load_mesh reads, or a cloud of points of one view (.pcd, a .ply or .obj without faces), of which
/// make_scan_surface makes a surface. @throws Error with the file's name, the value found and what was
/// expected.
ObjectModel load_object(const std::filesystem::path& file, const ObjectReadOptions& options = {});

}  // namespace eigengrasp
