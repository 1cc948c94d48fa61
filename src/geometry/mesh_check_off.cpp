// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <vector>

#include "geometry/mesh_file_checks.hpp"
#include "geometry/ply_writer.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

struct OffCounts {
  std::int64_t vertices = 0, faces = 0;
};

OffCounts read_header(TextLines& lines) {
  std::string_view word;
  if (lines.next()) word = lines.word();
  if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF")
    lines.fail_here("begins with \"{}\", expected \"OFF\"; check what the file is", lines.shown(word));
  word = lines.word();
  if (word.empty() && lines.next()) word = lines.word();
  OffCounts counts;
  counts.vertices = lines.integer_of(word, "the number of vertices");
  counts.faces = lines.integer("the number of faces");
  if (counts.vertices < 1 || counts.faces < 1)
    lines.fail_here("has {} vertices and {} faces, expected a surface; export faces as well", counts.vertices,
                    counts.faces);
  return counts;
}

/// The count alone must not make anyone ask for memory that the file cannot fill.
void require_lines(const TextLines& lines, const OffCounts& counts, std::size_t bytes) {
  const auto most = static_cast<std::int64_t>(bytes);
  if (counts.vertices > most || counts.faces > most)
    lines.fail_here("says {} vertices and {} faces, but the file has only {} bytes; export the mesh again",
                    counts.vertices, counts.faces, bytes);
}

void read_face(TextLines& lines, const OffCounts& counts, PlyWriter& mesh) {
  std::vector<std::int32_t> face;
  const std::int64_t corners = lines.integer("the number of corners");
  if (corners < 3 || corners > kMaxCorners)
    lines.fail_here("the face has {} corners, expected 3 to {}; export triangles", corners, kMaxCorners);
  for (std::int64_t k = 0; k < corners; ++k) {
    const std::int64_t index = lines.integer("a vertex index");
    if (index < 0 || index >= counts.vertices)
      lines.fail_here("the face uses vertex {}, but there are only {} (0 to {}); export the mesh again",
                      index, counts.vertices, counts.vertices - 1);
    face.push_back(static_cast<std::int32_t>(index));
  }
  mesh.add_face(face);
}

}  // namespace

CheckedMeshFile check_off(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  const OffCounts counts = read_header(lines);
  require_lines(lines, counts, content.size());
  PlyWriter mesh;
  for (std::int64_t v = 0; v < counts.vertices; ++v) {
    if (!lines.next())
      lines.fail_here("ends after {} of {} vertices; the file is cut off", v, counts.vertices);
    const double x = lines.number("x"), y = lines.number("y"), z = lines.number("z");
    mesh.add_vertex({x, y, z});
  }
  for (std::int64_t f = 0; f < counts.faces; ++f) {
    if (!lines.next()) lines.fail_here("ends after {} of {} faces; the file is cut off", f, counts.faces);
    read_face(lines, counts, mesh);
  }
  return {mesh.face_count(), mesh.content()};
}

}  // namespace eigengrasp
