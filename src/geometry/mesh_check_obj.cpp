// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <limits>
#include <vector>

#include "geometry/mesh_file_checks.hpp"
#include "geometry/ply_writer.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

/// What the faces of the text refer to.
struct ObjText {
  PlyWriter mesh;
  std::int64_t largest = -1;  ///< index of a corner, from 0
  int line_of_largest = 0;
  std::vector<std::int32_t> face;  ///< kept for its memory
};

/// One corner, such as 3, 3/1, 3//2 or -1/-1/-1, of which the first number counts.
void read_corner(const TextLines& lines, std::string_view word, ObjText& text) {
  const std::int64_t index = lines.integer_of(word.substr(0, word.find('/')), "a vertex index");
  const auto count = static_cast<std::int64_t>(text.mesh.vertex_count());
  if (index == 0) lines.fail_here("the face uses vertex 0, but they count from 1; export the mesh again");
  if (index < -count)
    lines.fail_here("the face uses vertex {}, but there are only {} so far; export the mesh again", index,
                    count);
  if (index > std::numeric_limits<std::int32_t>::max())
    lines.fail_here("the face uses vertex {}, which no file holds; export the mesh again", index);
  const std::int64_t corner = index < 0 ? count + index : index - 1;
  if (corner > text.largest) {
    text.largest = corner;
    text.line_of_largest = lines.line();
  }
  text.face.push_back(static_cast<std::int32_t>(corner));
}

void read_face(TextLines& lines, ObjText& text) {
  text.face.clear();
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word())
    read_corner(lines, word, text);
  const std::size_t corners = text.face.size();
  if (corners < 3)
    lines.fail_here("the face has {} corners, expected at least 3; the file may be cut off", corners);
  if (corners > static_cast<std::size_t>(kMaxCorners))
    lines.fail_here("the face has {} corners, expected at most {}; export triangles", corners, kMaxCorners);
  text.mesh.add_face(text.face);
}

}  // namespace

CheckedMeshFile check_obj(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  ObjText text;
  while (lines.next()) {
    const std::string_view keyword = lines.word();
    if (keyword == "v") {  // a weight or a colour may follow
      const double x = lines.number("x"), y = lines.number("y"), z = lines.number("z");
      text.mesh.add_vertex({x, y, z});
    } else if (keyword == "f") {
      read_face(lines, text);
    }
  }
  const auto vertices = static_cast<std::int64_t>(text.mesh.vertex_count());
  const std::size_t faces = text.mesh.face_count();
  if (vertices == 0 && faces == 0)
    fail("{}: has neither vertices (v) nor faces (f), so it is not a Wavefront OBJ file; check what it is",
         file.string());
  if (text.largest >= vertices)
    fail_at(file, text.line_of_largest,
            "the face uses vertex {}, but there are only {}; the file may be cut off, export the mesh again",
            text.largest + 1, vertices);
  if (faces == 0)
    fail("{}: has {} vertices but no faces, expected a surface; export faces as well", file.string(),
         vertices);
  return {faces, text.mesh.content()};
}

}  // namespace eigengrasp
