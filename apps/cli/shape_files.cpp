// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/shape_files.hpp"

#include <algorithm>
#include <filesystem>

#include "cli/json_lines.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace eigengrasp::cli {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> meshes_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_mesh_file(entry.path())) files.push_back(entry.path());
  if (files.empty())
    fail("{}: holds no mesh, expected files such as .obj, .stl, .ply or .off", folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

NamedDescriptor described(const fs::path& file, const ShapeReading& reading) {
  ObjectReadOptions options;
  options.units = reading.units;
  const ObjectModel object = load_sound_object(file, options);
  DescriptorOptions how;
  how.function = parse_shape_function(reading.function);
  try {
    return {object.name, compute_shape_descriptor(object.mesh, how)};
  } catch (const Error& e) {
    fail("{}: {}", file.string(), e.what());
  }
}

std::string text_member(const JsonLine& line, const char* name) {
  const auto& member = line.member(name);
  if (!member.is_string()) line.fail_because(fmt::format("{} is no text", name));
  return member.get<std::string>();
}

NamedDescriptor read_line(const JsonLine& line, const ShapeReading& reading) {
  if (const std::string function = text_member(line, "function"); function != reading.function)
    line.fail_because(fmt::format("is a descriptor of the {}, expected one of the {} (--function)", function,
                                  reading.function));
  const VecX invariants = line.numbers("invariants", static_cast<int>(kDescriptorSize));
  ShapeBall ball;
  ball.center = line.vector("center");
  ball.radius = line.number("radius", 1.0);
  const bool moments = text_member(line, "route") == to_string(DescriptorRoute::moments);
  return {
      text_member(line, "name"),
      make_shape_descriptor({invariants.begin(), invariants.end()}, parse_shape_function(reading.function),
                            moments ? DescriptorRoute::moments : DescriptorRoute::voxels, ball)};
}

}  // namespace

std::vector<NamedDescriptor> describe_shapes(const std::vector<std::string>& shapes,
                                             const ShapeReading& reading) {
  std::vector<fs::path> meshes;
  std::vector<NamedDescriptor> known;
  for (const std::string& shape : shapes) {
    if (fs::path(shape).extension() == ".jsonl") {
      for (const JsonLine& line : read_json_lines(shape)) known.push_back(read_line(line, reading));
    } else if (fs::is_directory(shape)) {
      for (const fs::path& file : meshes_below(shape)) meshes.push_back(file);
    } else {
      meshes.push_back(find_object(shape));
    }
  }
  std::vector<NamedDescriptor> all(meshes.size());
  parallel_for(meshes.size(), reading.threads,
               [&](std::size_t i, int) { all[i] = described(meshes[i], reading); });
  all.insert(all.end(), known.begin(), known.end());
  return all;
}

nlohmann::ordered_json descriptor_json(const NamedDescriptor& named) {
  const ShapeDescriptor& d = named.descriptor;
  const Vec3& c = d.ball.center;
  return {{"name", named.name},          {"function", to_string(d.function)},
          {"route", to_string(d.route)}, {"center", {c.x(), c.y(), c.z()}},
          {"radius", d.ball.radius},     {"invariants", d.invariants}};
}

}  // namespace eigengrasp::cli
