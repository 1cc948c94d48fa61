// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/uploaded_mesh.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/model_io/object_io.hpp"
#include "server/scratch_folder.hpp"
#include "server/upload_name.hpp"

namespace eigengrasp::server {

namespace fs = std::filesystem;

namespace {

constexpr double kLongest = 100.0;  // side of an object's box [m]

std::string mesh_ending(const std::string& file_name) {
  const std::string ending = ending_of(file_name);
  constexpr std::array<const char*, 6> known = {".obj", ".stl", ".ply", ".off", ".glb", ".pcd"};
  if (std::find(known.begin(), known.end(), ending) == known.end())
    fail("the name ends in '{}', expected .obj, .stl, .ply, .off, .glb or .pcd", ending.substr(0, 16));
  return ending;
}

}  // namespace

void require_whole(const std::string& ending, const std::string& bytes) {
  if (ending == ".glb" && bytes.find("\"uri\"") != std::string::npos)
    fail("the GLB refers to other files (uri), expected one that holds everything; export it again that way");
}

UploadedMesh read_uploaded_mesh(const std::string& file_name, const std::string& units,
                                const std::string& bytes, std::int64_t max_triangles) {
  const std::string ending = mesh_ending(file_name);
  require_whole(ending, bytes);
  const ScratchFolder scratch;
  const std::string name = sound_name(fs::path(file_name).stem().string(), "object");
  const fs::path file = scratch.path() / (name + ending);
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    auto object = std::make_shared<ObjectModel>(load_object(file, {.units = units.empty() ? "m" : units}));
    object->source.clear();  // nothing that is still there
    if (static_cast<std::int64_t>(object->mesh.triangles.size()) > max_triangles)
      fail("the mesh has {} triangles, expected at most {}; simplify it", object->mesh.triangles.size(),
           max_triangles);
    const MeshReport report = inspect_mesh(object->mesh);
    if (report.degenerate_triangles >= static_cast<int>(object->mesh.triangles.size()))
      fail("none of the {} triangles has an area, expected a surface", object->mesh.triangles.size());
    if (const double side = report.box.size().maxCoeff(); side > kLongest)
      fail("the mesh is {:.4g} m long, expected at most {} m; are its units mm?", side, kLongest);
    return {name, std::move(object)};
  } catch (const Error& e) {
    throw Error(scratch.hidden_in(e.what()));
  }
}

}  // namespace eigengrasp::server
