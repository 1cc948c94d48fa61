// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <array>
#include <string>

#include "geometry/mesh_file_checks.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

constexpr std::array<std::string_view, 3> kKinds = {"vertex", "texture coordinate", "normal"};

/// Counts of vertices, texture coordinates and normals, and the largest index into each.
struct ObjCounts {
  std::array<std::int64_t, 3> count{};
  std::array<std::int64_t, 3> largest{};
  std::array<int, 3> line_of_largest{};
};

void check_vertex(TextLines& lines) {
  for (const char* axis : {"x", "y", "z"}) lines.number(axis);
  int extra = 0;
  double w = 1.0;
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word())
    if (++extra == 1) w = std::atof(std::string(word).c_str());
  if (extra == 1 && w == 0.0)
    lines.fail_here("the vertex has weight 0, expected three numbers; mend the line");
}

/// One corner, such as 3, 3/1, 3//2 or -1/-1/-1.
void check_corner(const TextLines& lines, std::string_view corner, ObjCounts& counts) {
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const std::size_t slash = std::min(corner.find('/'), corner.size());
    const std::string_view text = corner.substr(0, slash);
    corner.remove_prefix(std::min(slash + 1, corner.size()));
    if (text.empty() && kind > 0) continue;
    const std::int64_t index = lines.integer_of(text, "a vertex index");
    if (index == 0)
      lines.fail_here("the face uses {} 0, but they count from 1; export the mesh again", kKinds[kind]);
    if (index < -counts.count[kind])
      lines.fail_here("the face uses {} {}, but there are only {} so far; export the mesh again",
                      kKinds[kind], index, counts.count[kind]);
    if (index > counts.largest[kind]) {
      counts.largest[kind] = index;
      counts.line_of_largest[kind] = lines.line();
    }
  }
  if (!corner.empty())
    lines.fail_here("the corner has more than three indices, expected vertex/texture/normal; mend the line");
}

void check_face(TextLines& lines, ObjCounts& counts) {
  std::int64_t corners = 0;
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word(), ++corners)
    check_corner(lines, word, counts);
  if (corners < 3)
    lines.fail_here("the face has {} corners, expected at least 3; the file may be cut off", corners);
  if (corners > kMaxCorners)
    lines.fail_here("the face has {} corners, expected at most {}; export triangles", corners, kMaxCorners);
}

}  // namespace

MeshFileFacts check_obj(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  ObjCounts counts;
  std::size_t faces = 0;
  while (lines.next()) {
    const std::string_view keyword = lines.word();
    if (keyword == "v") {
      check_vertex(lines);
      ++counts.count[0];
    } else if (keyword == "vt") {
      ++counts.count[1];
    } else if (keyword == "vn") {
      ++counts.count[2];
    } else if (keyword == "f") {
      check_face(lines, counts);
      ++faces;
    }
  }
  if (counts.count[0] == 0 && faces == 0)
    fail("{}: has neither vertices (v) nor faces (f), so it is not a Wavefront OBJ file; check what it is",
         file.string());
  for (std::size_t kind = 0; kind < 3; ++kind)
    if (counts.largest[kind] > counts.count[kind])
      fail_at(file, counts.line_of_largest[kind],
              "the face uses {} {}, but there are only {}; the file may be cut off, export the mesh again",
              kKinds[kind], counts.largest[kind], counts.count[kind]);
  if (faces == 0)
    fail("{}: has {} vertices but no faces, expected a surface; export faces as well", file.string(),
         counts.count[0]);
  return {faces, content};
}

}  // namespace eigengrasp
