// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/scene_options.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/object_checks.hpp"
#include "eigengrasp/model_io/graspit_io.hpp"
#include "eigengrasp/model_io/hand_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace eigengrasp::cli {

void warn(const std::string& sentence) {
  fmt::print(stderr, "eigengrasp: warning: {}\n", sentence);
}

std::shared_ptr<PreparationCache> user_cache() {
  const auto folder = user_cache_folder();
  if (folder.empty()) return {};
  return std::make_shared<PreparationCache>(PreparationCacheOptions{.folder = folder, .log = warn});
}

void add_hand_option(CLI::App& command, HandChoice& choice) {
  command.add_option(
      "--hand", choice.name,
      "Name of a shipped hand (see 'eigengrasp hand list'), folder with a hand.yaml, or GraspIt! robot XML");
}

void add_graspit_options(CLI::App& command, HandChoice& choice, const std::string& contacts) {
  command
      .add_option(contacts, choice.contact_files,
                  "GraspIt! virtual contact files, instead of the robot file's")
      ->delimiter(',');
  command.add_option("--eigengrasp-file", choice.eigengrasp_file,
                     "GraspIt! eigengrasp file, instead of the robot file's");
}

void add_scene_options(CLI::App& command, SceneChoice& choice) {
  add_hand_option(command, choice.hand);
  add_graspit_options(command, choice.hand);
  command.add_option("--units", choice.units,
                     "Units of the object's file: m, cm, mm, in (GraspIt! files: mm, else m)");
  command.add_option("--scale", choice.scale, "Makes the object this many times larger");
  command.add_option(
      "--table", choice.table,
      "A table with its top at this height in the object's frame [m]; 'auto': right below the object");
  command
      .add_option("--obstacle", choice.obstacles, "Meshes to keep away from, in the object's frame and units")
      ->delimiter(',');
  command.add_option("--world", choice.world,
                     "GraspIt! world: object, obstacles and, without --hand, the hand");
  command.add_option("--friction", choice.friction,
                     "Coulomb coefficient of every contact, instead of the materials'");
}

std::shared_ptr<const HandModel> load_hand_choice(const HandChoice& choice) {
  HandReadOptions options;
  options.graspit_contact_files = choice.contact_files;
  options.graspit_eigengrasp_file = choice.eigengrasp_file;
  options.log = warn;
  return std::make_shared<HandModel>(load_hand(find_hand(choice.name), options));
}

ObjectUnits object_units(const SceneChoice& choice) {
  const std::string ending = std::filesystem::path(choice.object).extension().string();
  const bool graspit =
      !choice.world.empty() || ending == ".xml" || ending == ".iv" || ending == ".IV" || ending == ".wrl";
  return {!choice.units.empty() ? choice.units : graspit ? "mm" : "m", choice.scale};
}

ObjectModel load_sound_object(const std::filesystem::path& file, const ObjectReadOptions& options) {
  ObjectModel object = load_object(file, options);
  if (inspect_mesh(object.mesh).degenerate_triangles >= static_cast<int>(object.mesh.triangles.size()))
    fail("{}: none of its {} triangles has an area, expected a surface", file.string(),
         object.mesh.triangles.size());
  return object;
}

namespace {

double number(const std::string& text, const char* option) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    fail("{} is '{}', expected a height in metres or 'auto'", option, text);
  return value;
}

void load_world(const SceneChoice& choice, Scene& scene) {
  const GraspitWorld world = load_graspit_world(choice.world);
  if (world.graspable.empty()) fail("{}: has no graspableBody, expected one to grasp", choice.world.string());
  const Pose X_OW = world.graspable.front().X_WO.inverse();
  scene.object = std::make_shared<ObjectModel>(load_graspit_body(world.graspable.front().file));
  const auto add_obstacle = [&](const GraspitWorld::Body& body) {
    scene.obstacles.push_back(
        {std::make_shared<ObjectModel>(load_graspit_body(body.file)), X_OW * body.X_WO});
  };
  std::for_each(world.graspable.begin() + 1, world.graspable.end(), add_obstacle);
  std::for_each(world.obstacles.begin(), world.obstacles.end(), add_obstacle);
  if (!choice.hand.name.empty()) return;
  if (world.robots.empty()) fail("{}: has no robot; name a hand with --hand", choice.world.string());
  HandChoice hand = choice.hand;
  hand.name = world.robots.front().file.string();
  scene.hand = load_hand_choice(hand);
}

void load_object_choice(const SceneChoice& choice, Scene& scene) {
  if (choice.loaded_object) {
    scene.object = choice.loaded_object;
    return;
  }
  if (choice.object.empty())
    fail("no object is given; name a mesh file, one of 'eigengrasp object list', or a --world");
  ObjectReadOptions options;
  options.units = choice.units;
  options.scale = choice.scale;
  scene.object = std::make_shared<ObjectModel>(load_sound_object(find_object(choice.object), options));
}

void set_sound_friction(Scene& scene, double friction) {
  if (!(friction >= 0.0) || !std::isfinite(friction)) fail("--friction is {}, expected 0 or more", friction);
  set_friction(scene, friction);
}

}  // namespace

std::vector<Scene> load_scenes(const std::vector<std::string>& hands,
                               const std::vector<std::string>& objects) {
  std::vector<std::shared_ptr<const ObjectModel>> models;
  for (const std::string& object : objects)
    models.push_back(std::make_shared<ObjectModel>(load_sound_object(find_object(object), {})));
  std::vector<Scene> scenes;
  for (const std::string& name : hands) {
    HandChoice choice;
    choice.name = name;
    const auto hand = load_hand_choice(choice);
    for (const auto& object : models) {
      Scene scene;
      scene.hand = hand;
      scene.object = object;
      scene.object_material.name = object->material;
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

Scene load_scene(const SceneChoice& choice) {
  Scene scene;
  if (!choice.world.empty()) {
    if (!choice.object.empty())
      fail("both an object ({}) and a --world are given; give one of them", choice.object);
    load_world(choice, scene);
  } else {
    load_object_choice(choice, scene);
  }
  if (!scene.hand) {
    if (choice.hand.name.empty()) fail("no hand is given; name one with --hand (see 'eigengrasp hand list')");
    scene.hand = load_hand_choice(choice.hand);
  }
  scene.object_material.name = scene.object->material;
  for (const std::string& sentence : size_warnings(inspect_mesh(scene.object->mesh), hand_reach(*scene.hand)))
    warn(sentence);
  for (const auto& file : choice.obstacles) {
    ObjectReadOptions options;
    options.units = choice.units;
    scene.obstacles.push_back(
        {std::make_shared<ObjectModel>(load_sound_object(file, options)), Pose::Identity()});
  }
  if (!choice.table.empty())
    scene.obstacles.push_back(make_table(choice.table == "auto" ? bounding_box(scene.object->mesh).min.z()
                                                                : number(choice.table, "--table")));
  if (choice.friction) set_sound_friction(scene, *choice.friction);
  return scene;
}

}  // namespace eigengrasp::cli
