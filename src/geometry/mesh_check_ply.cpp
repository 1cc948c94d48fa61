// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "geometry/mesh_file_checks.hpp"
#include "geometry/ply_writer.hpp"
#include "geometry/point_file_readers.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

struct PlyType {
  std::string_view name, other_name;
  std::size_t bytes;
  char kind;  ///< 'i' signed, 'u' unsigned, 'f' floating
};
constexpr std::array<PlyType, 8> kTypes = {{{"char", "int8", 1, 'i'},
                                            {"uchar", "uint8", 1, 'u'},
                                            {"short", "int16", 2, 'i'},
                                            {"ushort", "uint16", 2, 'u'},
                                            {"int", "int32", 4, 'i'},
                                            {"uint", "uint32", 4, 'u'},
                                            {"float", "float32", 4, 'f'},
                                            {"double", "float64", 8, 'f'}}};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;

  const PlyProperty* find(std::string_view property) const {
    for (const PlyProperty& p : properties)
      if (p.name == property) return &p;
    return nullptr;
  }
};

struct PlyHeader {
  std::string_view format;
  std::vector<PlyElement> elements;
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

const PlyType* type_of(TextLines& lines) {
  const std::string_view word = lines.word();
  for (const PlyType& type : kTypes)
    if (word == type.name || word == type.other_name) return &type;
  lines.fail_here("found \"{}\" where a type such as float or int was expected; mend the line",
                  lines.shown(word));
}

void read_property(TextLines& lines, PlyHeader& header) {
  if (header.elements.empty()) lines.fail_here("a property before the first element; mend the header");
  PlyProperty property;
  TextLines ahead = lines;
  if (ahead.word() == "list") {
    lines.word();
    property.count_type = type_of(lines);
    if (property.count_type->kind == 'f')
      lines.fail_here("a list counts in floats, expected integers; mend the line");
  }
  property.type = type_of(lines);
  property.name = lines.word();
  header.elements.back().properties.push_back(property);
}

void read_element(TextLines& lines, PlyHeader& header) {
  PlyElement element;
  element.name = lines.word();
  element.count = lines.integer("the number of elements");
  if (element.count < 0)
    lines.fail_here("says {} of {}, expected 0 or more; mend the line", element.count, element.name);
  header.elements.push_back(element);
}

PlyHeader read_header(TextLines& lines) {
  PlyHeader header;
  if (!lines.next() || lines.word() != "ply")
    lines.fail_here("does not begin with \"ply\", so it is not a PLY file; check what it is");
  while (lines.next()) {
    const std::string_view word = lines.word();
    if (word == "end_header") return header;
    if (word == "format") {
      header.format = lines.word();
      if (header.format != "ascii" && header.format != "binary_little_endian" &&
          header.format != "binary_big_endian")
        lines.fail_here("the format is \"{}\", expected ascii, binary_little_endian or binary_big_endian",
                        lines.shown(header.format));
    } else if (word == "element") {
      read_element(lines, header);
    } else if (word == "property") {
      read_property(lines, header);
    } else if (word != "comment" && word != "obj_info") {
      lines.fail_here("found \"{}\" in the header, expected element, property or end_header; mend the line",
                      lines.shown(word));
    }
  }
  lines.fail_here("ends where \"end_header\" was expected; the file is cut off");
}

bool is_corner_list(const PlyElement& element, const PlyProperty& property) {
  return element.name == "face" && property.count_type != nullptr &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// The header must tell of vertices, and of no more than the bytes can hold; for a surface also of faces.
void check_header(const TextLines& lines, PlyHeader& header, std::size_t bytes, bool surface) {
  const auto refuse = [&](std::string_view found) {
    fail("{}: {}; export it again", lines.file().string(), found);
  };
  if (header.format.empty()) refuse("the header names no format, expected one such as \"format ascii 1.0\"");
  bool has_corners = false;
  for (const PlyElement& element : header.elements) {
    if (element.count > static_cast<std::int64_t>(bytes))
      refuse(fmt::format("says {} of {}, but has only {} bytes of them; it is cut off", element.count,
                         lines.shown(element.name), bytes));
    if (element.count > 0 && element.properties.empty())
      refuse(fmt::format("the element \"{}\" has no properties", lines.shown(element.name)));
    if (element.name == "vertex") {
      header.vertices = element.count;
      for (const char* axis : {"x", "y", "z"})
        if (const PlyProperty* p = element.find(axis); p == nullptr || p->count_type != nullptr)
          refuse(fmt::format("the vertices have no property {}, expected x, y and z", axis));
    }
    if (element.name != "face") continue;
    if (header.vertices == 0) refuse("has faces before or without vertices, expected vertices first");
    header.faces = element.count;
    for (const PlyProperty& property : element.properties) has_corners |= is_corner_list(element, property);
  }
  if (header.vertices == 0)
    refuse(surface ? "has no vertices, expected a surface" : "has no vertices, expected points");
  if (!surface) return;
  if (header.faces == 0)
    fail("{}: is a cloud of {} points without faces, expected a surface; reconstruct one first",
         lines.file().string(), header.vertices);
  if (!has_corners) refuse("the faces have no list vertex_indices");
}

/// Reads the numbers of the body, one at a time.
class PlyBody {
 public:
  virtual ~PlyBody() = default;
  virtual void begin_row(const PlyElement& element, std::int64_t row) = 0;
  virtual double read(const PlyType& type) = 0;
  virtual void end_row() {}
  [[noreturn]] virtual void refuse(const std::string& sentence) const = 0;
};

class TextBody : public PlyBody {
 public:
  TextBody(TextLines& lines, bool may_be_nan) : lines_(lines), may_be_nan_(may_be_nan) {}
  void begin_row(const PlyElement& element, std::int64_t row) override {
    if (!lines_.next())
      lines_.fail_here("ends after {} of {} rows of {}; the file is cut off", row, element.count,
                       lines_.shown(element.name));
  }
  double read(const PlyType& type) override {
    if (type.kind != 'f') return static_cast<double>(lines_.integer("an integer"));
    return may_be_nan_ ? lines_.number_or_nan("a number") : lines_.number("a number");
  }
  void end_row() override {
    if (const auto word = lines_.word(); !word.empty())
      lines_.fail_here("found \"{}\" where the line should end; mend the line", lines_.shown(word));
  }
  [[noreturn]] void refuse(const std::string& sentence) const override { lines_.fail_here("{}", sentence); }

 private:
  TextLines& lines_;
  bool may_be_nan_ = false;
};

class BinaryBody : public PlyBody {
 public:
  BinaryBody(const std::filesystem::path& file, std::string_view bytes, bool big)
      : file_(file), bytes_(bytes), swap_(big != (std::endian::native == std::endian::big)) {}
  void begin_row(const PlyElement& element, std::int64_t row) override {
    element_ = &element;
    row_ = row;
  }
  double read(const PlyType& type) override {
    if (bytes_.size() < type.bytes)
      fail("{}: ends within row {} of {} of {}; the file is cut off", file_.string(), row_, element_->count,
           TextLines::shown(element_->name));
    char raw[8];
    std::memcpy(raw, bytes_.data(), type.bytes);
    bytes_.remove_prefix(type.bytes);
    if (swap_) std::reverse(raw, raw + type.bytes);
    switch (type.bytes) {
      case 1:
        return type.kind == 'i' ? as<std::int8_t>(raw) : as<std::uint8_t>(raw);
      case 2:
        return type.kind == 'i' ? as<std::int16_t>(raw) : as<std::uint16_t>(raw);
      case 4:
        return type.kind == 'i'   ? as<std::int32_t>(raw)
               : type.kind == 'u' ? as<std::uint32_t>(raw)
                                  : as<float>(raw);
      default:
        return as<double>(raw);
    }
  }
  [[noreturn]] void refuse(const std::string& sentence) const override {
    fail("{}: row {} of {}: {}", file_.string(), row_, TextLines::shown(element_->name), sentence);
  }

 private:
  template <typename T>
  static double as(const char* raw) {
    T value;
    std::memcpy(&value, raw, sizeof value);
    return static_cast<double>(value);
  }
  const std::filesystem::path& file_;
  std::string_view bytes_;
  bool swap_;
  const PlyElement* element_ = nullptr;
  std::int64_t row_ = 0;
};

void read_list(PlyBody& body, const PlyHeader& header, const PlyProperty& property, bool corners,
               PlyWriter& mesh) {
  std::vector<std::int32_t> face;
  const double count = body.read(*property.count_type);
  if (count < 0 || (corners && (count < 3 || count > static_cast<double>(kMaxCorners))))
    body.refuse(fmt::format("a list of {} corners, expected 3 to {}; export triangles", count, kMaxCorners));
  for (double k = 0; k < count; ++k) {
    const double index = body.read(*property.type);
    if (!corners) continue;
    if (!(index >= 0 && index < static_cast<double>(header.vertices)))
      body.refuse(
          fmt::format("the face uses vertex {}, but there are only {} (0 to {}); export the mesh again",
                      index, header.vertices, header.vertices - 1));
    face.push_back(static_cast<std::int32_t>(index));
  }
  if (corners) mesh.add_face(face);
}

void read_row(PlyBody& body, const PlyHeader& header, const PlyElement& element, PlyWriter& mesh) {
  Vec3 p = Vec3::Zero();
  for (const PlyProperty& property : element.properties) {
    if (property.count_type != nullptr) {
      read_list(body, header, property, is_corner_list(element, property), mesh);
      continue;
    }
    const double value = body.read(*property.type);
    if (element.name != "vertex" || property.name.size() != 1) continue;
    if (!(std::abs(value) <= std::numeric_limits<float>::max()))
      body.refuse(fmt::format("{} is not finite, expected a number; export the mesh again",
                              TextLines::shown(property.name)));
    const char axis = property.name[0];
    if (axis >= 'x' && axis <= 'z') p[axis - 'x'] = value;
  }
  if (element.name == "vertex") mesh.add_vertex(p);
}

PlyWriter read_rows(PlyBody& body, const PlyHeader& header) {
  PlyWriter mesh;
  for (const PlyElement& element : header.elements)
    for (std::int64_t row = 0; row < element.count; ++row) {
      body.begin_row(element, row);
      read_row(body, header, element, mesh);
      body.end_row();
    }
  return mesh;
}

/// One row; x, y and z of a vertex go to p, everything else is passed over.
void skip_row(PlyBody& body, const PlyElement& element, Vec3& p) {
  for (const PlyProperty& property : element.properties) {
    const double value = body.read(property.count_type != nullptr ? *property.count_type : *property.type);
    if (property.count_type != nullptr) {
      if (value < 0) body.refuse(fmt::format("a list of {} numbers, expected 0 or more", value));
      for (double k = 0; k < value; ++k) body.read(*property.type);
    } else if (property.name == "x" || property.name == "y" || property.name == "z") {
      p[property.name[0] - 'x'] = value;
    }
  }
}

PointCloud read_points(PlyBody& body, const PlyHeader& header) {
  PointCloud cloud;
  for (const PlyElement& element : header.elements) {
    for (std::int64_t row = 0; row < element.count; ++row) {
      Vec3 p = Vec3::Zero();
      body.begin_row(element, row);
      skip_row(body, element, p);
      body.end_row();
      if (element.name == "vertex") cloud.points.push_back(p);
    }
    if (element.name == "vertex") break;  // what follows are faces, or rows of a range image
  }
  return cloud;
}

}  // namespace

bool ply_has_no_faces(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  const PlyHeader header = read_header(lines);
  for (const PlyElement& element : header.elements)
    if (element.name == "face" && element.count > 0) return false;
  return true;
}

PointCloud read_ply_points(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  PlyHeader header = read_header(lines);
  const std::string_view rows = content.substr(lines.position());
  check_header(lines, header, rows.size(), false);
  if (header.format == "ascii") {
    TextBody body(lines, true);
    return read_points(body, header);
  }
  BinaryBody body(file, rows, header.format == "binary_big_endian");
  return read_points(body, header);
}

CheckedMeshFile check_ply(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  PlyHeader header = read_header(lines);
  const std::string_view rows = content.substr(lines.position());
  check_header(lines, header, rows.size(), true);
  PlyWriter mesh;
  if (header.format == "ascii") {
    TextBody body(lines, false);
    mesh = read_rows(body, header);
  } else {
    BinaryBody body(file, rows, header.format == "binary_big_endian");
    mesh = read_rows(body, header);
  }
  return {mesh.face_count(), mesh.content()};
}

}  // namespace eigengrasp
