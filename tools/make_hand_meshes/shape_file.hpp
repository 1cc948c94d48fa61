// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eigengrasp/modeling/solid.hpp"

namespace eigengrasp::shapes {

/// One mesh to make.
struct ShapeRecipe {
  std::string name;     ///< of the file, without .obj
  double cell = 0.001;  ///< of the grid [m]
  std::size_t triangles = 1200;
  modeling::Solid solid;
};

/// Reads a shapes.yaml (docs/hand-shapes.md), in the order of the file.
/// @throws Error with file and line for anything that is not understood
std::vector<ShapeRecipe> load_shapes(const std::filesystem::path& file);

}  // namespace eigengrasp::shapes
