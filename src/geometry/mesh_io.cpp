// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/mesh_io.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "geometry/mesh_file_checks.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 9> kEndings = {"obj", "stl", "ply", "off", "gltf",
                                                      "glb", "dae", "3ds", "fbx"};
constexpr double kMaxReach = 1e6;  // [m]

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

/// Everything that can be said of a file without looking inside.
void check_file(const fs::path& file) {
  std::error_code ec;
  const auto status = fs::status(file, ec);
  if (!fs::exists(status)) fail("{}: there is no such file; check the path", file.string());
  if (fs::is_directory(status))
    fail("{}: is a folder, expected a mesh file; name a file in it", file.string());
  if (!fs::is_regular_file(status)) fail("{}: is not a regular file, expected a mesh file", file.string());
  if (!is_mesh_file(file))
    fail("{}: the ending \"{}\" is not that of a mesh file, expected one of {}; convert or rename the file",
         file.string(), file.extension().string(), fmt::join(kEndings, ", "));
  const auto bytes = fs::file_size(file, ec);
  if (!ec && bytes == 0) fail("{}: is empty, expected a mesh; write the file again", file.string());
  if (!ec && bytes > kMaxFileBytes)
    fail("{}: has {} MB, expected at most {} MB; reduce the number of triangles", file.string(), bytes >> 20,
         kMaxFileBytes >> 20);
}

/// Post-processing of Assimp reads the vertices of a face without asking, so this must come first.
void check_faces(const aiScene& scene, const fs::path& file) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f)
      for (unsigned k = 0; k < part.mFaces[f].mNumIndices; ++k)
        if (part.mFaces[f].mIndices[k] >= part.mNumVertices)
          fail("{}: face {} uses vertex {}, but there are only {} vertices; export the mesh again",
               file.string(), f, part.mFaces[f].mIndices[k], part.mNumVertices);
  }
}

/// Adds the triangles of a part, placed by its node.
void add_part(const aiMesh& part, const aiMatrix4x4& placement, TriangleMesh& mesh) {
  const auto offset = static_cast<std::int32_t>(mesh.vertices.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D p = placement * part.mVertices[v];
    mesh.vertices.emplace_back(p.x, p.y, p.z);
  }
  const bool mirrored = placement.Determinant() < 0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    TriangleMesh::Triangle t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = offset + static_cast<std::int32_t>(face.mIndices[k]);
    if (mirrored) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
}

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, const fs::path& file,
              TriangleMesh& mesh) {
  const aiMatrix4x4 placement = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    add_part(*scene.mMeshes[node.mMeshes[i]], placement, mesh);
    if (mesh.triangles.size() > kMaxTriangles || mesh.vertices.size() > 3 * kMaxTriangles)
      fail("{}: has more than {} triangles; simplify the mesh", file.string(), kMaxTriangles);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], placement, file, mesh);
}

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find_first_of("\r\n")));
}

/// The formats that are checked in full; no value for the others.
std::optional<CheckedMeshFile> check_content(const fs::path& file, const std::string& ending,
                                             std::string_view content) {
  if (ending == "obj") return check_obj(file, content);
  if (ending == "off") return check_off(file, content);
  if (ending == "stl") return check_stl(file, content);
  if (ending == "ply") return check_ply(file, content);
  if (ending == "gltf" || ending == "glb") return check_gltf(file, content);
  if (ending == "dae") check_dae(file, content);
  return std::nullopt;
}

/// Assimp drops faces that it cannot read; the check knows how many there are.
void check_face_count(const aiScene& scene, std::size_t expected, const fs::path& file) {
  std::size_t faces = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    for (unsigned f = 0; f < scene.mMeshes[m]->mNumFaces; ++f)
      faces += scene.mMeshes[m]->mFaces[f].mNumIndices >= 3;
  if (faces != expected)
    fail("{}: has {} faces of which {} can be read, so it is damaged; export the mesh again", file.string(),
         expected, faces);
}

TriangleMesh import_mesh(const fs::path& file) {
  const std::string ending = ending_of(file);
  const std::string content = read_text_file(file);
  const std::optional<CheckedMeshFile> checked = check_content(file, ending, content);
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_TEXCOORDS | aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                  aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                                  aiComponent_CAMERAS | aiComponent_MATERIALS);
  const std::string& bytes = checked ? checked->as_ply : content;
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, checked ? "ply" : ending.c_str());
  if (scene == nullptr)
    fail("{}: cannot be read as a mesh ({}); export it again", file.string(),
         first_line(importer.GetErrorString()));
  check_faces(*scene, file);
  if (checked) check_face_count(*scene, checked->faces, file);
  scene = importer.ApplyPostProcessing(aiProcess_RemoveComponent | aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr)
    fail("{}: the polygons cannot be cut into triangles; export triangles", file.string());
  TriangleMesh mesh;
  add_node(*scene, *scene->mRootNode, aiMatrix4x4(), file, mesh);
  return mesh;
}

void check_vertices(const TriangleMesh& mesh, const fs::path& file, double scale) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite())
      fail("{}: vertex {} is not finite, expected three numbers; export the mesh again", file.string(), v);
    const double reach = mesh.vertices[v].cwiseAbs().maxCoeff() * scale;
    if (!(reach <= kMaxReach))
      fail("{}: reaches {:.3g} m from its origin, expected at most 1000 km; check the units and the scale",
           file.string(), reach);
  }
}

}  // namespace

double unit_length(const std::string& unit) {
  if (unit == "m") return 1.0;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  if (unit == "in") return 0.0254;
  fail("unknown unit \"{}\", expected m, cm, mm or in", unit);
}

bool is_mesh_file(const fs::path& file) {
  return std::find(kEndings.begin(), kEndings.end(), ending_of(file)) != kEndings.end();
}

TriangleMesh load_mesh(const fs::path& file, const MeshReadOptions& options) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale))
    fail("{}: the scale is {}, expected a number above 0", file.string(), options.scale);
  check_file(file);
  TriangleMesh mesh;
  try {
    mesh = import_mesh(file);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    fail("{}: cannot be read as a mesh ({}); export it again", file.string(), first_line(e.what()));
  }
  check_vertices(mesh, file, options.scale * options.later_scale);
  transform(mesh, Pose::Identity(), options.scale);
  weld(mesh, 0.0);
  if (mesh.empty()) fail("{}: has no triangles, expected a surface; export faces as well", file.string());
  return mesh;
}

}  // namespace eigengrasp
