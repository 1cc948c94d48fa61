// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eigengrasp/core/parallel.hpp"

namespace eigengrasp::cli {

struct AddObjectsChoice {
  std::string store;
  std::filesystem::path folder;  ///< of meshes; empty with library
  std::string units;             ///< of the meshes; empty: by the files' kind
  bool psb = false;              ///< the Princeton Shape Benchmark's layout; its meshes have no units
  bool library = false;          ///< the shipped objects, by name instead of by path
  bool keep_size = false;        ///< no rescaling, whatever the size
  std::vector<double> scales = {0.75, 1.0, 1.25, 1.5};
  std::filesystem::path thumbnails;  ///< folder for a picture of each object; empty: none
  int threads = 0;
};

struct AddObjectsReport {
  std::string place;  ///< of the store
  std::size_t added = 0, there = 0;
  std::vector<std::string> bad;     ///< sentences about meshes that were left out
  std::vector<std::string> absent;  ///< names of classified models without a mesh
  bool stopped = false;
};

/// Adds a folder's meshes to a store, which is opened (or made) once the choice is known to be sound: reads,
/// measures and rescales them. A bad mesh is left out.
/// @throws Error where the choice is wrong, the folder has no mesh, or the store refuses a model
AddObjectsReport add_objects(const AddObjectsChoice& choice, const StopFlag& stop);

}  // namespace eigengrasp::cli
