// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace eigengrasp {

/// Most corners of a polygon: cutting one into triangles takes time that grows with the square or worse.
inline constexpr std::int64_t kMaxCorners = 512;
/// Most triangles of a mesh.
inline constexpr std::size_t kMaxTriangles = 20'000'000;

/// A mesh file that may be handed to the reader.
struct CheckedMeshFile {
  std::optional<std::size_t> faces;  ///< faces of at least three corners that a reader must find
  std::string_view content;          ///< the part of the content to read
  std::string as_ply;                ///< not empty: a binary PLY file to read in its place
};

/// Assimp mends, drops or trips over much that is wrong in a file: faces that index beyond the vertices, cut
/// files, counts that no memory holds. These look at the whole content first. Each costs about as much as
/// reading the numbers once. Texts of vertices and faces (OBJ, OFF, STL as text) are known in full after
/// that, so they are handed on as PLY.
/// @throws Error with file, line (of a text format), what was found, what was expected and how to mend it.
CheckedMeshFile check_obj(const std::filesystem::path& file, std::string_view content);
CheckedMeshFile check_off(const std::filesystem::path& file, std::string_view content);
CheckedMeshFile check_stl(const std::filesystem::path& file, std::string_view content);
CheckedMeshFile check_ply(const std::filesystem::path& file, std::string_view content);
/// Both kinds: a text, or a binary container that begins with "glTF".
CheckedMeshFile check_gltf(const std::filesystem::path& file, std::string_view content);

}  // namespace eigengrasp
