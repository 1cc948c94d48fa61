// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eigengrasp {

/// A model of the Princeton Shape Benchmark.
struct PsbModel {
  int number = 0;
  std::filesystem::path mesh;     ///< .../db/12/m1234/m1234.off
  std::vector<std::string> tags;  ///< its class, outermost first: aircraft, airplane, F117
  bool test = false;              ///< of the test half of the classification
};

struct PsbLibrary {
  std::vector<PsbModel> models;  ///< by number
  std::vector<int> absent;       ///< classified, but without a mesh
};

/// Reads the Princeton Shape Benchmark (Shilane et al. 2004) in its own layout: a folder with db/ and
/// classification/v1/base/{train,test}.cla, or one that has it as benchmark/. Meshes that no classification
/// names come without tags.
/// @throws Error where there is no such folder, or a classification is cut or damaged, with file and line
PsbLibrary load_psb(const std::filesystem::path& folder);

}  // namespace eigengrasp
