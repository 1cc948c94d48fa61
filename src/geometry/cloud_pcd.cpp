// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <liblzf/lzf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "eigengrasp/core/error.hpp"
#include "geometry/mesh_file_checks.hpp"
#include "geometry/point_file_readers.hpp"
#include "geometry/text_lines.hpp"

// The format: https://pointclouds.org/documentation/tutorials/pcd_file_format.html

namespace eigengrasp {

namespace {

static_assert(std::endian::native == std::endian::little, "PCD is in the order of the machine that wrote it");

struct PcdField {
  std::string name;
  std::int64_t bytes = 4;
  char type = 'F';
  std::int64_t count = 1;
  std::int64_t offset = 0;  ///< in a point [bytes]
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::int64_t points = -1;
  std::int64_t point_bytes = 0;
  std::string data;  ///< ascii, binary or binary_compressed
  std::optional<Vec3> viewpoint;
};

/// VIEWPOINT tx ty tz qw qx qy qz; writers that do not know put the sensor at the origin without a turn.
std::optional<Vec3> read_viewpoint(TextLines& lines) {
  Vec3 position = Vec3::Zero();
  for (double& x : position) x = lines.number("a position");
  const double w = lines.number("a quaternion");
  const bool turned = std::abs(w - 1.0) > 1e-9;
  if (position.isZero(0.0) && !turned) return std::nullopt;
  return position;
}

template <typename Set>
void each_field(TextLines& lines, PcdHeader& header, const Set& set) {
  for (PcdField& field : header.fields) set(field);
  if (const auto word = lines.word(); !word.empty())
    lines.fail_here("has more entries than the {} fields; mend the line", header.fields.size());
}

void read_line(TextLines& lines, std::string_view word, PcdHeader& header) {
  if (word == "FIELDS" || word == "COLUMNS") {
    for (auto name = lines.word(); !name.empty(); name = lines.word()) {
      header.fields.emplace_back();
      header.fields.back().name = std::string(name);
    }
  } else if (word == "SIZE") {
    each_field(lines, header, [&](PcdField& field) { field.bytes = lines.integer("a size in bytes"); });
  } else if (word == "TYPE") {
    each_field(lines, header, [&](PcdField& field) {
      const auto type = lines.word();
      if (type != "F" && type != "I" && type != "U")
        lines.fail_here("the type is \"{}\", expected F, I or U; mend the line", lines.shown(type));
      field.type = type[0];
    });
  } else if (word == "COUNT") {
    each_field(lines, header, [&](PcdField& field) { field.count = lines.integer("a count"); });
  } else if (word == "VIEWPOINT") {
    header.viewpoint = read_viewpoint(lines);
  } else if (word == "POINTS") {
    header.points = lines.integer("the number of points");
  } else if (word == "DATA") {
    header.data = std::string(lines.word());
  } else if (word != "VERSION" && word != "WIDTH" && word != "HEIGHT") {
    lines.fail_here("found \"{}\" in the header, expected an entry such as FIELDS, POINTS or DATA",
                    lines.shown(word));
  }
}

PcdHeader read_header(TextLines& lines) {
  PcdHeader header;
  while (header.data.empty() && lines.next()) read_line(lines, lines.word(), header);
  if (header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed")
    lines.fail_here("the data are \"{}\", expected ascii, binary or binary_compressed; check that it is PCD",
                    lines.shown(header.data));
  if (header.points <= 0)
    fail("{}: tells of {} points, expected at least one; save the cloud again", lines.file().string(),
         std::max<std::int64_t>(header.points, 0));
  if (header.points > static_cast<std::int64_t>(kMaxTriangles))
    fail("{}: has {} points, expected at most {}; thin the cloud", lines.file().string(), header.points,
         kMaxTriangles);
  for (PcdField& field : header.fields) {
    if (field.bytes < 1 || field.bytes > 8 || field.count < 0 || field.count > 4096)
      fail("{}: the field {} has {} numbers of {} bytes, expected at most 4096 of 1 to 8",
           lines.file().string(), lines.shown(field.name), field.count, field.bytes);
    field.offset = header.point_bytes;
    header.point_bytes += field.bytes * field.count;
  }
  return header;
}

const PcdField& find_axis(const PcdHeader& header, std::string_view name, const std::filesystem::path& file) {
  for (const PcdField& field : header.fields) {
    if (field.name != name) continue;
    if (field.type == 'F' && (field.bytes == 4 || field.bytes == 8) && field.count == 1) return field;
    fail("{}: the field {} is not one float of 4 or 8 bytes; save the cloud again", file.string(), name);
  }
  fail("{}: has no field {}, expected x, y and z; save the cloud again", file.string(), name);
}

double number_at(const char* bytes, const PcdField& field) {
  if (field.bytes == 8) {
    double value = 0.0;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  float value = 0.0F;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

std::vector<Vec3> read_ascii(TextLines& lines, const PcdHeader& header) {
  std::vector<Vec3> points;
  std::array<const PcdField*, 3> axes{};
  for (std::size_t k = 0; k < 3; ++k)
    axes[k] = &find_axis(header, std::string_view("xyz").substr(k, 1), lines.file());
  for (std::int64_t i = 0; i < header.points; ++i) {
    if (!lines.next()) lines.fail_here("ends after {} of {} points; the file is cut off", i, header.points);
    Vec3& p = points.emplace_back(Vec3::Zero());
    for (const PcdField& field : header.fields) {
      const auto axis = std::find(axes.begin(), axes.end(), &field);
      for (std::int64_t k = 0; k < field.count; ++k) {
        if (axis != axes.end()) {
          p[axis - axes.begin()] = lines.number_or_nan("a coordinate");
        } else if (lines.word().empty()) {
          lines.fail_here("the line ends where {} was expected; the file may be cut off",
                          lines.shown(field.name));
        }
      }
    }
  }
  return points;
}

/// The bytes of a compressed body: all x, then all y, and so on.
std::string unpacked(const PcdHeader& header, std::string_view body, const std::filesystem::path& file) {
  std::uint32_t packed = 0, full = 0;
  if (body.size() < 8) fail("{}: ends before its points; the file is cut off", file.string());
  std::memcpy(&packed, body.data(), 4);
  std::memcpy(&full, body.data() + 4, 4);
  const auto expected =
      static_cast<std::uint64_t>(header.points) * static_cast<std::uint64_t>(header.point_bytes);
  if (body.size() - 8 < packed) fail("{}: ends within its points; the file is cut off", file.string());
  if (full != expected)
    fail("{}: holds {} bytes of points, expected {}; save the cloud again", file.string(), full, expected);
  std::string bytes(full, '\0');
  if (lzf_decompress(body.data() + 8, packed, bytes.data(), full) != full)
    fail("{}: the compressed points are damaged; save the cloud again", file.string());
  return bytes;
}

std::vector<Vec3> read_binary(std::string_view body, const PcdHeader& header,
                              const std::filesystem::path& file) {
  const bool columns = header.data == "binary_compressed";
  std::string storage;
  if (columns) {
    storage = unpacked(header, body, file);
    body = storage;
  }
  if (static_cast<std::int64_t>(body.size()) < header.points * header.point_bytes)
    fail("{}: has {} bytes of points, expected {}; the file is cut off", file.string(), body.size(),
         header.points * header.point_bytes);
  std::vector<Vec3> points(static_cast<std::size_t>(header.points));
  for (int k = 0; k < 3; ++k) {
    const PcdField& axis =
        find_axis(header, std::string_view("xyz").substr(static_cast<std::size_t>(k), 1), file);
    const char* first = body.data() + (columns ? axis.offset * header.points : axis.offset);
    const std::int64_t step = columns ? axis.bytes : header.point_bytes;
    for (std::int64_t i = 0; i < header.points; ++i)
      points[static_cast<std::size_t>(i)][k] = number_at(first + i * step, axis);
  }
  return points;
}

}  // namespace

PointCloud read_pcd_points(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  const PcdHeader header = read_header(lines);
  PointCloud cloud;
  cloud.viewpoint = header.viewpoint;
  cloud.points = header.data == "ascii" ? read_ascii(lines, header)
                                        : read_binary(content.substr(lines.position()), header, file);
  return cloud;
}

}  // namespace eigengrasp
