// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "eigengrasp/core/pose.hpp"

namespace eigengrasp {

/// Polygons as a binary PLY file in memory. Each vertex begins with a byte of 0, because Assimp takes bytes
/// right behind the head that happen to be those of a line's end for a part of it.
class PlyWriter {
 public:
  void add_vertex(const Vec3& p) {
    append(positions_, std::uint8_t{0});
    for (const double x : p) put(static_cast<float>(x));
    ++vertices_;
  }
  /// Corners count from 0; at most 65535 of them. They may name vertices that are added later.
  void add_face(std::span<const std::int32_t> corners) {
    append(faces_, static_cast<std::uint16_t>(corners.size()));
    for (const std::int32_t corner : corners) append(faces_, corner);
    ++n_faces_;
  }
  std::size_t vertex_count() const { return vertices_; }
  std::size_t face_count() const { return n_faces_; }

  std::string content() const {
    const char* order = std::endian::native == std::endian::little ? "little" : "big";
    return fmt::format(
               "ply\nformat binary_{}_endian 1.0\nelement vertex {}\nproperty uchar guard\nproperty float x\n"
               "property float y\nproperty float z\nelement face {}\nproperty list ushort int "
               "vertex_indices\nend_header\n",
               order, vertices_, n_faces_) +
           positions_ + faces_;
  }

 private:
  template <typename T>
  static void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(float value) { append(positions_, value); }

  std::string positions_, faces_;
  std::size_t vertices_ = 0, n_faces_ = 0;
};

}  // namespace eigengrasp
