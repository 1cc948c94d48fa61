// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "eigengrasp/geometry/object_model.hpp"

namespace eigengrasp::server {

struct UploadedMesh {
  std::string name;  ///< letters, digits, '.', '_' and '-'; at most 48; without the file's ending
  std::shared_ptr<const ObjectModel> object;
};

/// Refuses a GLB whose buffers are in other files, which would be looked for beside it. @param ending of its
/// name
void require_whole(const std::string& ending, const std::string& bytes);

/// Reads a mesh that a client sent: OBJ, STL, PLY, OFF or GLB that is whole in itself, each checked in full
/// while it is read. The file lives in a folder of its own while it is read.
/// @throws Error, one sentence, which does not name that folder.
UploadedMesh read_uploaded_mesh(const std::string& file_name, const std::string& units,
                                const std::string& bytes, std::int64_t max_triangles);

}  // namespace eigengrasp::server
