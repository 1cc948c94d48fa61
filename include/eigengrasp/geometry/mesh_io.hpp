// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <filesystem>
#include <string>

#include "eigengrasp/core/log.hpp"
#include "eigengrasp/geometry/triangle_mesh.hpp"

namespace eigengrasp {

/// Metres of one unit: "m", "cm", "mm" or "in". @throws Error for another name, listing these.
double unit_length(const std::string& unit);

struct MeshReadOptions {
  double scale = 1.0;        ///< vertices are multiplied by this: units and user scale together
  double later_scale = 1.0;  ///< by which the caller multiplies them: the bound on the size is that after it
};

/// Reads OBJ, STL, PLY, OFF and glTF/GLB, checked in full, and COLLADA, 3DS and FBX as Assimp reads them, as
/// one triangle mesh in the file's own frame (axes as written; nodes placed), welded exactly. A unit that a
/// COLLADA file states is applied. Polygons are triangulated; lines and points are dropped. Coordinates have
/// single precision. Not for Open Inventor (see model_io).
/// @throws Error with the file's name (and line, of a text) for a missing, unreadable, truncated or empty
/// file, non-finite vertices, faces that index beyond the vertices or have more than 512 corners, more than
/// 1 GiB or 20 million triangles, or a size beyond 1000 km after both scales.
TriangleMesh load_mesh(const std::filesystem::path& file, const MeshReadOptions& options = {});

/// Whether load_mesh knows the file name's ending.
bool is_mesh_file(const std::filesystem::path& file);

}  // namespace eigengrasp
