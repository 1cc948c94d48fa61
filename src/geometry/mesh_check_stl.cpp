// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <array>
#include <cctype>
#include <cstring>
#include <string>

#include "geometry/mesh_file_checks.hpp"
#include "geometry/ply_writer.hpp"
#include "geometry/text_lines.hpp"

namespace eigengrasp {

namespace {

constexpr std::size_t kHeader = 84, kRecord = 50;  // [byte]

std::size_t binary_count(std::string_view content) {
  std::uint32_t count = 0;
  if (content.size() >= kHeader) std::memcpy(&count, content.data() + 80, sizeof count);
  return count;
}

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The word "solid" also begins many binary files; those have zeros or a fitting size.
bool is_text(std::string_view content) {
  if (content.size() >= kHeader && content.size() >= kHeader + kRecord * binary_count(content)) return false;
  const std::string head = lower(content.substr(0, kHeader));
  return head.find("solid") != std::string::npos && head.find('\0') == std::string::npos;
}

CheckedMeshFile check_binary(const std::filesystem::path& file, std::string_view content) {
  const std::size_t count = binary_count(content);
  const std::size_t expected = kHeader + kRecord * count;
  if (content.size() < kHeader)
    fail("{}: has {} bytes, expected at least {} of an STL file; it is cut off or not an STL file",
         file.string(), content.size(), kHeader);
  if (content.size() < expected)
    fail("{}: has {} bytes, expected {} for the {} triangles of its header; it is cut off or not an STL file",
         file.string(), content.size(), expected, count);
  if (count == 0) fail("{}: has no triangles, expected a surface; export faces as well", file.string());
  PlyWriter mesh;
  for (std::size_t t = 0; t < count; ++t) {
    float corners[9];  // after the normal
    std::memcpy(corners, content.data() + kHeader + kRecord * t + 12, sizeof corners);
    for (const float c : corners)
      if (!std::isfinite(c))
        fail("{}: triangle {} has a corner that is not finite, expected numbers; export the mesh again",
             file.string(), t);
    for (int k = 0; k < 3; ++k) mesh.add_vertex({corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]});
    const auto first = static_cast<std::int32_t>(3 * t);
    mesh.add_face(std::array{first, first + 1, first + 2});
  }
  return {count, mesh.content()};
}

/// Goes to the next line, which must begin with a keyword.
void expect(TextLines& lines, std::string_view keyword) {
  if (!lines.next()) lines.fail_here("ends where \"{}\" was expected; the file is cut off", keyword);
  if (const std::string_view word = lines.word(); lower(word) != keyword)
    lines.fail_here("found \"{}\" where \"{}\" was expected; mend the line", lines.shown(word), keyword);
}

CheckedMeshFile check_text(const std::filesystem::path& file, std::string_view content) {
  TextLines lines(file, content);
  PlyWriter mesh;
  bool inside = false;  // between solid and endsolid
  while (lines.next()) {
    const std::string word = lower(lines.word());
    if (word == "solid" && !inside) {
      inside = true;
    } else if (word == "endsolid" && inside) {
      inside = false;
    } else if (word == "facet" && inside) {
      expect(lines, "outer");
      for (int k = 0; k < 3; ++k) {
        expect(lines, "vertex");
        const double x = lines.number("x"), y = lines.number("y"), z = lines.number("z");
        mesh.add_vertex({x, y, z});
      }
      expect(lines, "endloop");
      expect(lines, "endfacet");
      const auto last = static_cast<std::int32_t>(mesh.vertex_count()) - 1;
      mesh.add_face(std::array{last - 2, last - 1, last});
    } else {
      lines.fail_here("found \"{}\" where \"{}\" was expected; mend the line", lines.shown(word),
                      inside ? "facet" : "solid");
    }
  }
  if (inside) lines.fail_here("ends where \"endsolid\" was expected; the file is cut off");
  if (mesh.face_count() == 0)
    fail("{}: has no triangles, expected a surface; export faces as well", file.string());
  return {mesh.face_count(), mesh.content()};
}

}  // namespace

CheckedMeshFile check_stl(const std::filesystem::path& file, std::string_view content) {
  return is_text(content) ? check_text(file, content) : check_binary(file, content);
}

}  // namespace eigengrasp
