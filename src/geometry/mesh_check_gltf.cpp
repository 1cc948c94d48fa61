// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "geometry/mesh_file_checks.hpp"
#include "geometry/ply_writer.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

using nlohmann::json;
constexpr int kMaxDepth = 100;  // of brackets in brackets

std::size_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

struct GltfParts {
  std::string_view json, binary;
};

/// The chunks of a binary container, whose lengths must fit the file.
GltfParts split_container(const std::filesystem::path& file, std::string_view content) {
  if (content.size() < 20)
    fail("{}: has {} bytes, expected at least 20 of a binary glTF file; it is cut off", file.string(),
         content.size());
  if (word_at(content, 4) != 2)
    fail("{}: has version {} of binary glTF, expected 2; export it again", file.string(),
         word_at(content, 4));
  if (word_at(content, 8) > content.size())
    fail("{}: has {} bytes, expected {} as its header says; it is cut off", file.string(), content.size(),
         word_at(content, 8));
  GltfParts parts;
  for (std::size_t at = 12; at < content.size();) {
    const std::size_t left = content.size() - at;
    if (left < 8 || word_at(content, at) > left - 8)
      fail("{}: a chunk at byte {} reaches beyond the end of the file; it is cut off or damaged",
           file.string(), at);
    const std::string_view chunk = content.substr(at + 8, word_at(content, at));
    if (at == 12) parts.json = chunk;
    if (at > 12 && parts.binary.empty()) parts.binary = chunk;
    at += 8 + chunk.size();
  }
  return parts;
}

/// The bytes of a base64 text; stops at the first character that is none.
std::string decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    std::uint32_t value = 0;
    if (c >= 'A' && c <= 'Z')
      value = static_cast<std::uint32_t>(c - 'A');
    else if (c >= 'a' && c <= 'z')
      value = static_cast<std::uint32_t>(c - 'a' + 26);
    else if (c >= '0' && c <= '9')
      value = static_cast<std::uint32_t>(c - '0' + 52);
    else if (c == '+')
      value = 62;
    else if (c == '/')
      value = 63;
    else
      break;
    bits = (bits << 6 | value) & 0xffffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count & 0xff));
  }
  return bytes;
}

/// A file name with its %20 resolved.
std::string decode_percent(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr == text.data() + i + 3) {
      name.push_back(static_cast<char>(value));
      i += 2;
    } else {
      name.push_back(text[i]);
    }
  }
  return name;
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

/// Entries of an accessor, in bounds of their buffer.
struct GltfEntries {
  const char* first = nullptr;
  std::size_t count = 0, stride = 0;
  int component = 0;

  template <typename T>
  T get(std::size_t entry, std::size_t k = 0) const {
    T value;
    std::memcpy(&value, first + entry * stride + k * sizeof value, sizeof value);
    return value;
  }
};

constexpr int kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;  // component types

/// Reads a glTF document without trust in it.
class GltfDocument {
 public:
  GltfDocument(const std::filesystem::path& file, json document, std::string_view binary)
      : file_(file), json_(std::move(document)), binary_(binary) {}

  PlyWriter read() {
    if (!json_.is_object() || !json_.contains("asset")) refuse("has no \"asset\", so it is not a glTF file");
    for (const json& extension : list("extensionsRequired"))
      if (extension != "KHR_materials_unlit" && extension != "KHR_texture_transform")
        refuse(fmt::format("needs the extension {}, expected plain data", shown(extension)));
    const auto& scenes = list("scenes");
    if (scenes.empty()) refuse("has no scene, expected one with a mesh");
    const std::size_t scene = json_.contains("scene") ? index(json_["scene"], scenes.size(), "scene") : 0;
    for (std::size_t b = 0; b < list("buffers").size(); ++b) load_buffer(list("buffers")[b]);
    parents_.assign(list("nodes").size(), 0);
    visit(scenes[scene], "nodes", Eigen::Affine3d::Identity(), 0);
    if (mesh_.face_count() == 0) refuse("shows no mesh with triangles, expected a surface");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& sentence) const {
    fail("{}: {}; export it again", file_.string(), sentence);
  }
  static std::string shown(const json& value) {
    return value.dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 40);
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
      refuse(fmt::format("names {} {}, but there are only {}", what, shown(value), count));
    return value.get<std::size_t>();
  }
  /// A number of bytes or entries; small enough that sums and products of two stay exact.
  std::size_t size(const json& object, const char* name, std::size_t otherwise) const {
    if (!object.is_object()) refuse(fmt::format("found {} where an object was expected", shown(object)));
    if (!object.contains(name)) return otherwise;
    if (!object[name].is_number_unsigned() || object[name].get<std::uint64_t>() > 0xffffffffu)
      refuse(fmt::format("\"{}\" is {}, expected a positive integer of 32 bits", name, shown(object[name])));
    return object[name].get<std::size_t>();
  }

  void load_buffer(const json& buffer) {
    const std::size_t expected = size(buffer, "byteLength", 0);
    std::string bytes;
    if (!buffer.contains("uri")) {
      bytes = binary_;
    } else if (!buffer["uri"].is_string()) {
      refuse("the uri of a buffer is not a text");
    } else if (const auto uri = buffer["uri"].get<std::string>(); uri.starts_with("data:")) {
      bytes = decode_base64(std::string_view(uri).substr(std::min(uri.find(','), uri.size() - 1) + 1));
    } else {
      bytes = read_beside(decode_percent(uri));
    }
    if (bytes.size() < expected)
      refuse(fmt::format("a buffer has {} bytes, expected {}; it is cut off", bytes.size(), expected));
    buffers_.push_back(std::move(bytes));
  }
  std::string read_beside(const std::string& name) const {
    std::error_code ec;
    const std::filesystem::path path = file_.parent_path() / name;
    if (name.find('\0') != std::string::npos || !std::filesystem::is_regular_file(path, ec))
      fail("{}: its numbers are in the file \"{}\", which is missing; put it beside", file_.string(),
           TextLines::shown(name));
    if (std::filesystem::file_size(path, ec) > kMaxFileBytes)
      refuse(fmt::format("the file \"{}\" is too large", TextLines::shown(name)));
    return read_text_file(path);
  }

  GltfEntries entries(const json& which, std::string_view type, const char* what) const {
    const json& accessor = list("accessors")[index(which, list("accessors").size(), "accessor")];
    GltfEntries found;
    found.count = size(accessor, "count", 0);
    found.component = static_cast<int>(size(accessor, "componentType", 0) & 0xffff);
    const bool floats = type == "VEC3";
    const std::size_t width = floats ? 12 : found.component == kByte ? 1 : found.component == kShort ? 2 : 4;
    const bool known = floats
                           ? found.component == kFloat
                           : found.component == kByte || found.component == kShort || found.component == kInt;
    if (accessor.value("type", json()) != type || !known)
      refuse(fmt::format("the {} are of a type that glTF does not have for them", what));
    if (accessor.contains("sparse") || !accessor.contains("bufferView"))
      refuse(fmt::format("the {} are compressed or sparse, expected plain data", what));
    const auto& views = list("bufferViews");
    const json& view = views[index(accessor["bufferView"], views.size(), "bufferView")];
    found.stride = size(view, "byteStride", width);
    if (!view.contains("buffer")) refuse("a bufferView names no buffer");
    const std::string& buffer = buffers_[index(view["buffer"], buffers_.size(), "buffer")];
    const std::size_t begin = size(view, "byteOffset", 0) + size(accessor, "byteOffset", 0);
    const std::size_t end = size(view, "byteOffset", 0) + size(view, "byteLength", 0);
    const std::size_t last = found.count == 0 ? begin : begin + found.stride * (found.count - 1) + width;
    if (found.stride < width || last > end || end > buffer.size() || found.count > 3 * kMaxTriangles)
      refuse(fmt::format("the {} entries of the {} reach beyond their buffer", found.count, what));
    found.first = buffer.data() + begin;
    return found;
  }

  static std::size_t corner(const GltfEntries& indices, std::size_t k) {
    if (indices.component == kByte) return indices.get<std::uint8_t>(k);
    if (indices.component == kShort) return indices.get<std::uint16_t>(k);
    return indices.get<std::uint32_t>(k);
  }

  void add_primitive(const json& primitive, const Eigen::Affine3d& placement) {
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object() ||
        !primitive["attributes"].contains("POSITION"))
      refuse("a primitive has no POSITION");
    const std::size_t mode = size(primitive, "mode", 4);
    if (mode < 4 || mode > 6) return;  // points and lines
    const GltfEntries points = entries(primitive["attributes"]["POSITION"], "VEC3", "positions");
    const bool indexed = primitive.contains("indices");
    const GltfEntries indices = indexed ? entries(primitive["indices"], "SCALAR", "indices") : GltfEntries{};
    const std::size_t corners = indexed ? indices.count : points.count;
    if (mesh_.vertex_count() + points.count > 3 * kMaxTriangles ||
        mesh_.face_count() + corners / (mode == 4 ? 3 : 1) > kMaxTriangles)
      refuse(fmt::format("has more than {} triangles", kMaxTriangles));
    const auto offset = static_cast<std::int32_t>(mesh_.vertex_count());
    for (std::size_t v = 0; v < points.count; ++v) {
      const Vec3 p(points.get<float>(v, 0), points.get<float>(v, 1), points.get<float>(v, 2));
      if (!p.allFinite()) refuse(fmt::format("position {} is not finite, expected three numbers", v));
      const Vec3 placed = placement * p;
      if (!(placed.cwiseAbs().maxCoeff() < 1e37)) refuse(fmt::format("position {} is beyond all bounds", v));
      mesh_.add_vertex(placed);
    }
    const bool mirrored = placement.linear().determinant() < 0;
    for (std::size_t t = 0; mode == 4 ? 3 * t + 2 < corners : t + 2 < corners; ++t) {
      std::array<std::size_t, 3> face = {3 * t, 3 * t + 1, 3 * t + 2};
      if (mode == 5) face = {t, t + 1 + t % 2, t + 2 - t % 2};
      if (mode == 6) face = {0, t + 1, t + 2};
      add_face(face, indexed ? &indices : nullptr, points.count, offset, mirrored);
    }
  }
  void add_face(const std::array<std::size_t, 3>& face, const GltfEntries* indices, std::size_t n_points,
                std::int32_t offset, bool mirrored) {
    std::array<std::int32_t, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t point = indices != nullptr ? corner(*indices, face[k]) : face[k];
      if (point >= n_points)
        refuse(fmt::format("a triangle uses position {}, but there are only {}", point, n_points));
      corners[k] = offset + static_cast<std::int32_t>(point);
    }
    if (mirrored) std::swap(corners[1], corners[2]);
    mesh_.add_face(corners);
  }

  /// Numbers of a node, such as its translation; false where they are absent.
  template <std::size_t N>
  bool numbers(const json& node, const char* name, std::array<double, N>& values) const {
    if (!node.contains(name)) return false;
    const json& given = list_of(node, name);
    if (given.size() != N) refuse(fmt::format("\"{}\" has {} numbers, expected {}", name, given.size(), N));
    for (std::size_t k = 0; k < N; ++k) {
      if (!given[k].is_number())
        refuse(fmt::format("\"{}\" holds {}, expected numbers", name, shown(given[k])));
      values[k] = given[k].get<double>();
    }
    return true;
  }
  Eigen::Affine3d placement_of(const json& node) const {
    Eigen::Affine3d placement = Eigen::Affine3d::Identity();
    std::array<double, 16> m;
    if (numbers(node, "matrix", m)) {
      placement.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
      return placement;
    }
    std::array<double, 3> t{}, s{1, 1, 1};
    std::array<double, 4> q{0, 0, 0, 1};
    numbers(node, "translation", t);
    numbers(node, "scale", s);
    numbers(node, "rotation", q);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(turn.norm() > 0)) refuse("a node is turned by a quaternion of length 0");
    placement.translate(Vec3(t[0], t[1], t[2])).rotate(turn.normalized()).scale(Vec3(s[0], s[1], s[2]));
    return placement;
  }

  /// A node has one parent, so the nodes are trees; anything else would repeat its parts without bound.
  void visit(const json& holder, const char* name, const Eigen::Affine3d& parent, int depth) {
    if (depth > kMaxDepth) refuse(fmt::format("nests nodes more than {} deep", kMaxDepth));
    for (const json& child : list_of(holder, name)) {
      const std::size_t n = index(child, parents_.size(), "node");
      if (parents_[n]++ > 0) refuse(fmt::format("node {} has more than one parent, expected a tree", n));
      const json& node = list("nodes")[n];
      if (!node.is_object()) refuse(fmt::format("node {} is not an object", n));
      const Eigen::Affine3d placement = parent * placement_of(node);
      if (node.contains("mesh")) {
        const json& mesh = list("meshes")[index(node["mesh"], list("meshes").size(), "mesh")];
        for (const json& primitive : list_of(mesh, "primitives")) add_primitive(primitive, placement);
      }
      visit(node, "children", placement, depth + 1);
    }
  }

  const std::filesystem::path& file_;
  json json_;
  std::string_view binary_;
  std::vector<std::string> buffers_;
  std::vector<int> parents_;
  PlyWriter mesh_;
};

}  // namespace

CheckedMeshFile check_gltf(const std::filesystem::path& file, std::string_view content) {
  GltfParts parts{content, {}};
  if (content.starts_with("glTF")) parts = split_container(file, content);
  check_depth(file, parts.json);
  json document = json::parse(parts.json, nullptr, false);
  if (document.is_discarded())
    fail("{}: is not valid JSON, expected a glTF document; it is cut off or not a glTF file", file.string());
  const PlyWriter mesh = GltfDocument(file, std::move(document), parts.binary).read();
  return {mesh.face_count(), mesh.content()};
}

}  // namespace eigengrasp
