// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/uploaded_mesh.hpp"

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/model_io/object_io.hpp"

namespace eigengrasp::server {

namespace fs = std::filesystem;

namespace {

constexpr double kLongest = 100.0;  // side of an object's box [m]

/// A folder that goes with everything in it.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "eigengrasp-upload-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) fail("the server has no room for uploads; is its disk full?");
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string ending_of(const std::string& file_name) {
  std::string ending = fs::path(file_name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<const char*, 5> known = {".obj", ".stl", ".ply", ".off", ".glb"};
  if (std::find(known.begin(), known.end(), ending) == known.end())
    fail("the name ends in '{}', expected .obj, .stl, .ply, .off or .glb", ending.substr(0, 16));
  return ending;
}

std::string sound_name(const std::string& file_name) {
  std::string name = fs::path(file_name).stem().string().substr(0, 48);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '_';
  if (name.empty() || name.front() == '.') name.insert(0, "object");
  return name;
}

/// A GLB whose buffers are in other files would have them looked for beside it.
void require_whole(const std::string& ending, const std::string& bytes) {
  if (ending == ".glb" && bytes.find("\"uri\"") != std::string::npos)
    fail("the GLB refers to other files (uri), expected one that holds everything; export it again that way");
}

std::string without(std::string text, const std::string& part, const std::string& instead) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += instead.size())
    text.replace(at, part.size(), instead);
  return text;
}

}  // namespace

UploadedMesh read_uploaded_mesh(const std::string& file_name, const std::string& units,
                                const std::string& bytes, std::int64_t max_triangles) {
  const std::string ending = ending_of(file_name);
  require_whole(ending, bytes);
  const ScratchFolder scratch;
  const std::string name = sound_name(file_name);
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
    throw Error(without(e.what(), scratch.path().string() + "/", ""));
  }
}

}  // namespace eigengrasp::server
