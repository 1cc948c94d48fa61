// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace eigengrasp {

/// Most corners of a polygon: cutting one into triangles takes time that grows with the square or worse.
inline constexpr std::int64_t kMaxCorners = 512;
/// Largest file.
inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30;
/// Most triangles of a mesh.
inline constexpr std::size_t kMaxTriangles = 20'000'000;

/// A mesh file that was read in full without trust in it.
struct CheckedMeshFile {
  std::size_t faces = 0;  ///< all of at least three corners
  std::string as_ply;     ///< its vertices and faces as a binary PLY file
};

/// Assimp mends, drops or trips over much that is wrong in a file: faces that index beyond the vertices, cut
/// files, counts that no memory holds, accessors beyond their buffers. So these look at the whole content
/// first and hand on the vertices and faces alone, in a plain form. Each costs about as much as reading the
/// numbers once.
/// @throws Error with file, line (of a text format), what was found, what was expected and how to mend it.
CheckedMeshFile check_obj(const std::filesystem::path& file, std::string_view content);
CheckedMeshFile check_off(const std::filesystem::path& file, std::string_view content);
CheckedMeshFile check_stl(const std::filesystem::path& file, std::string_view content);
CheckedMeshFile check_ply(const std::filesystem::path& file, std::string_view content);
/// Both kinds: a text, or a binary container that begins with "glTF".
CheckedMeshFile check_gltf(const std::filesystem::path& file, std::string_view content);
/// Looks at the tags, the counts and the lists of indices alone: what makes Assimp hang or ask for memory
/// without bound.
void check_dae(const std::filesystem::path& file, std::string_view content);

}  // namespace eigengrasp
