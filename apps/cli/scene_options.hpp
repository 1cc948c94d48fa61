// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigengrasp/geometry/preparation_cache.hpp"
#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "eigengrasp/report/grasp_file.hpp"

namespace eigengrasp::cli {

/// Which hand, as the user says it.
struct HandChoice {
  std::string name;                                  ///< name, folder, hand.yaml or GraspIt! XML
  std::vector<std::filesystem::path> contact_files;  ///< of GraspIt!
  std::filesystem::path eigengrasp_file;             ///< of GraspIt!
};

/// Which scene, as the user says it.
struct SceneChoice {
  std::string object;
  std::shared_ptr<const ObjectModel> loaded_object;  ///< null: what `object` names is loaded
  HandChoice hand;
  std::string units;
  double scale = 1.0;
  std::string table;  ///< height in the object frame [m], or "auto"
  std::vector<std::filesystem::path> obstacles;
  std::filesystem::path world;  ///< of GraspIt!
  std::optional<double> friction;
};

/// --hand
void add_hand_option(CLI::App& command, HandChoice& choice);
/// Files of GraspIt! beside the robot's. @param contacts name of the option for contact files
void add_graspit_options(CLI::App& command, HandChoice& choice, const std::string& contacts = "--contacts");
void add_scene_options(CLI::App& command, SceneChoice& choice);

/// Warnings of the readers go to stderr.
std::shared_ptr<const HandModel> load_hand_choice(const HandChoice& choice);
Scene load_scene(const SceneChoice& choice);
/// Every hand with every object, each loaded once.
std::vector<Scene> load_scenes(const std::vector<std::string>& hands,
                               const std::vector<std::string>& objects);
/// @throws Error where the file is bad, or none of its triangles has an area.
ObjectModel load_sound_object(const std::filesystem::path& file, const ObjectReadOptions& options);

/// For the files that are written.
ObjectUnits object_units(const SceneChoice& choice);

/// In the user's cache folder; none where there is no such folder.
std::shared_ptr<PreparationCache> user_cache();

/// "eigengrasp: warning: ..." on stderr.
void warn(const std::string& sentence);

}  // namespace eigengrasp::cli
