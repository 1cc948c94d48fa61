// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "geometry/mesh_file_checks.hpp"

namespace eigengrasp {

namespace {

using nlohmann::json;
constexpr int kMaxDepth = 100;  // of brackets in brackets

std::size_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// The JSON text of a binary container, whose lengths must fit the file.
std::string_view json_chunk(const std::filesystem::path& file, std::string_view content) {
  if (content.size() < 20)
    fail("{}: has {} bytes, expected at least 20 of a binary glTF file; it is cut off", file.string(),
         content.size());
  if (word_at(content, 4) != 2)
    fail("{}: has version {} of binary glTF, expected 2; export it again", file.string(),
         word_at(content, 4));
  if (word_at(content, 8) > content.size())
    fail("{}: has {} bytes, expected {} as its header says; it is cut off", file.string(), content.size(),
         word_at(content, 8));
  std::string_view text;
  for (std::size_t at = 12; at < content.size();) {
    const std::size_t left = content.size() - at;
    if (left < 8 || word_at(content, at) > left - 8)
      fail("{}: a chunk at byte {} reaches beyond the end of the file; it is cut off or damaged",
           file.string(), at);
    if (at == 12) text = content.substr(20, word_at(content, 12));
    at += 8 + word_at(content, at);
  }
  return text;
}

/// Readers of JSON recurse; the brackets must not fill the stack.
void check_depth(const std::filesystem::path& file, std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kMaxDepth)
      fail("{}: nests brackets more than {} deep, so it is not a glTF file; check what it is", file.string(),
           kMaxDepth);
  }
}

/// Looks into a glTF document without trust in it.
class GltfDocument {
 public:
  GltfDocument(const std::filesystem::path& file, json document) : file_(file), json_(std::move(document)) {}

  /// Faces that the shown scene's meshes have; each mesh counts once.
  std::size_t check() {
    if (!json_.is_object() || !json_.contains("asset")) refuse("has no \"asset\", so it is not a glTF file");
    const auto& scenes = list("scenes");
    if (scenes.empty()) refuse("has no scene, expected one with a mesh");
    const std::size_t scene = json_.contains("scene") ? index(json_["scene"], scenes.size(), "scene") : 0;
    parents_.assign(list("nodes").size(), 0);
    used_.assign(list("meshes").size(), 0);
    visit(scenes[scene], "nodes", 0);
    std::size_t faces = 0, placed = 0;
    for (std::size_t m = 0; m < used_.size(); ++m) {
      const std::size_t of_mesh = mesh_faces(list("meshes")[m]);
      placed += used_[m] * of_mesh;
      corners_ += of_mesh;
      faces += used_[m] > 0 ? of_mesh : 0;
      if (placed > kMaxTriangles || corners_ > kMaxTriangles)
        refuse(fmt::format("has more than {} triangles", kMaxTriangles));
    }
    if (faces == 0) refuse("shows no mesh with triangles, expected a surface");
    return faces;
  }

 private:
  [[noreturn]] void refuse(const std::string& sentence) const {
    fail("{}: {}; export it again", file_.string(), sentence);
  }
  const json& list(const char* name) const { return list_of(json_, name); }
  const json& list_of(const json& object, const char* name) const {
    static const json none = json::array();
    if (!object.is_object() || !object.contains(name)) return none;
    if (!object[name].is_array()) refuse(fmt::format("\"{}\" is not a list", name));
    return object[name];
  }
  std::size_t index(const json& value, std::size_t count, const char* what) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
      refuse(fmt::format("names {} {}, but there are only {}", what, value.dump().substr(0, 20), count));
    return value.get<std::size_t>();
  }
  /// A node has one parent, so the nodes are trees; anything else would repeat its parts without bound.
  void visit(const json& holder, const char* name, int depth) {
    if (depth > kMaxDepth) refuse(fmt::format("nests nodes more than {} deep", kMaxDepth));
    for (const json& child : list_of(holder, name)) {
      const std::size_t n = index(child, parents_.size(), "node");
      if (parents_[n]++ > 0) refuse(fmt::format("node {} has more than one parent, expected a tree", n));
      const json& node = list("nodes")[n];
      if (node.is_object() && node.contains("mesh")) ++used_[index(node["mesh"], used_.size(), "mesh")];
      visit(node, "children", depth + 1);
    }
  }
  std::size_t accessor_count(const json& which) const {
    const json& accessor = list("accessors")[index(which, list("accessors").size(), "accessor")];
    const bool counted = accessor.is_object() && accessor.contains("count");
    if (!counted || !accessor["count"].is_number_unsigned())
      refuse("an accessor has no count, expected a positive integer");
    if (!accessor.contains("bufferView"))
      refuse("an accessor names no bufferView (compressed or sparse data), expected plain data");
    const auto count = accessor["count"].get<std::uint64_t>();
    if (count > 3 * kMaxTriangles) refuse(fmt::format("an accessor has {} entries, too many", count));
    return count;
  }
  std::size_t mesh_faces(const json& mesh) {
    std::size_t faces = 0;
    for (const json& primitive : list_of(mesh, "primitives")) {
      if (!primitive.is_object() || !primitive.contains("attributes"))
        refuse("a primitive has no attributes");
      const json& attributes = primitive["attributes"];
      if (!attributes.is_object() || !attributes.contains("POSITION")) refuse("a primitive has no POSITION");
      std::size_t corners = 0;
      for (const auto& [key, which] : attributes.items()) corners_ += accessor_count(which);
      corners = accessor_count(attributes["POSITION"]);
      if (primitive.contains("indices")) corners = accessor_count(primitive["indices"]);
      const json mode = primitive.value("mode", json(4));
      if (mode == 4) faces += corners / 3;
      if ((mode == 5 || mode == 6) && corners > 2) faces += corners - 2;
    }
    return faces;
  }

  const std::filesystem::path& file_;
  json json_;
  std::vector<int> parents_;
  std::vector<std::size_t> used_;
  std::size_t corners_ = 0;  ///< a measure of the memory that a reader needs
};

}  // namespace

CheckedMeshFile check_gltf(const std::filesystem::path& file, std::string_view content) {
  const bool binary = content.starts_with("glTF");
  const std::string_view text = binary ? json_chunk(file, content) : content;
  check_depth(file, text);
  json document = json::parse(text, nullptr, false);
  if (document.is_discarded())
    fail("{}: is not valid JSON, expected a glTF document; it is cut off or not a glTF file", file.string());
  return {GltfDocument(file, std::move(document)).check(), content, {}};
}

}  // namespace eigengrasp
