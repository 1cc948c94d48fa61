// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eigengrasp {

// Hands and objects that can be named instead of given by path. They are looked for in, first wins:
// - the folders of the environment variable EIGENGRASP_HANDS (hands only; separated by colons; each holds
//   hands, or is one);
// - the data folder: the environment variable EIGENGRASP_DATA_DIR; without it ../share/eigengrasp beside the
//   running program, then where the library was installed, then the source tree it was built from.
// In the data folder a hand is hands/NAME/hand.yaml, an object objects/NAME.obj.

struct NamedModel {
  std::string name;
  std::filesystem::path path;  ///< for load_hand or load_object
};

/// Known hands by name, each once.
std::vector<NamedModel> list_hands();

/// Known objects by name, each once.
std::vector<NamedModel> list_objects();

/// The path of a hand: the argument itself where it is a file or a folder with hand.yaml, else that of the
/// known hand of that name. @throws Error that lists the known names, with the nearest.
std::filesystem::path find_hand(const std::string& name_or_path);

/// The path of an object: the argument itself where it is a file, else that of the known object of that name.
/// @throws Error that lists the known names, with the nearest.
std::filesystem::path find_object(const std::string& name_or_path);

/// The path of the known object of a name. @throws as find_object
std::filesystem::path find_library_object(const std::string& name);

/// The SQLite file of the grasps that are shipped: grasps/shipped.db of the data folder. @throws Error where
/// there is none
std::filesystem::path find_shipped_grasps();

}  // namespace eigengrasp
