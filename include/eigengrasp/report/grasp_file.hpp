// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "eigengrasp/grasp/scene.hpp"
#include "eigengrasp/planning/grasp_planner.hpp"

namespace eigengrasp {

/// The newest version of grasps.json that this program writes and reads; docs/grasps-json.md has the schema.
inline constexpr int kGraspFileVersion = 1;

/// A file that a result depends on.
struct SourceFile {
  std::string path;    ///< as it was given
  std::string digest;  ///< file_digest(path); empty where the file could not be read
};

/// The hand of a grasp file.
struct HandRecord {
  std::string name;
  SourceFile source;
  std::vector<std::string> joints;  ///< movable joints, in the hand's order
  std::vector<std::string> dofs;    ///< in the order of every "dofs" array
};

/// The object of a grasp file, in its frame O.
struct ObjectRecord {
  std::string name;
  SourceFile source;
  std::string units = "m";             ///< of the source file
  double scale = 1.0;                  ///< factor beside the units
  Vec3 center_of_mass = Vec3::Zero();  ///< [m]
  double max_radius = 0.0;             ///< largest distance of a vertex from it [m]
  bool watertight = false;
  Material material;  ///< name and friction
};

struct ObstacleRecord {
  std::string name;
  SourceFile source;  ///< of obstacles that come from a file, else empty
  Pose X_OB = Pose::Identity();
};

/// What grasps.json holds.
struct GraspFile {
  HandRecord hand;
  ObjectRecord object;
  std::vector<ObstacleRecord> obstacles;
  PlanOptions options;  ///< stop, progress are not kept
  PlanResult result;
  std::string version;  ///< of the program that wrote it
};

/// Units and scale with which the object's file was read.
struct ObjectUnits {
  std::string units = "m";
  double scale = 1.0;
};

/// Collects what a planner was given and found. Reads the source files for their digests.
GraspFile make_grasp_file(const Scene& scene, const ObjectUnits& units, const PlanOptions& options,
                          PlanResult result);

enum class RunPart {
  with,     ///< the whole file
  without,  ///< all but the member "run" (timings, threads): equal for equal results on any machine
};

/// The text of grasps.json: numbers with as many digits as reading them back exactly takes; the text of what
/// was read from such a text is the same text.
/// @throws std::logic_error for a number that is not finite.
std::string grasps_json(const GraspFile& file, RunPart run = RunPart::with);

/// @throws Error where the file cannot be written; it is then as it was.
void save_grasps(const GraspFile& file, const std::filesystem::path& path);

/// @param name what errors call the text, such as the file's path
/// @throws Error with the name, the JSON path, what was found and what was expected; for a file of a newer
/// version a sentence that says so. Unknown members are ignored.
GraspFile parse_grasps(std::string_view text, const std::string& name);
GraspFile load_grasps(const std::filesystem::path& path);

/// "fnv1a64:" and 16 hexadecimal digits of the 64-bit FNV-1a hash of some bytes, or of those of a file.
/// @throws Error where the file cannot be read.
std::string bytes_digest(std::string_view bytes);
std::string file_digest(const std::filesystem::path& path);

}  // namespace eigengrasp
