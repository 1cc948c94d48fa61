// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace eigengrasp {

/// A colour as people give it: sRGB components and opacity, each in [0, 1].
struct Color {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 1.0F;
};

/// A picture in memory: linear light, colour premultiplied with alpha, rows from the top.
struct Image {
  int width = 0;            ///< [pixel]
  int height = 0;           ///< [pixel]
  std::vector<float> rgba;  ///< (height x width x 4)

  Image() = default;
  /// Filled with one colour. @pre width, height >= 0
  Image(int width, int height, const Color& color);

  bool empty() const { return rgba.empty(); }
  float* pixel(int x, int y) { return rgba.data() + offset(x, y); }
  const float* pixel(int x, int y) const { return rgba.data() + offset(x, y); }
  /// The pixel as sRGB, not premultiplied.
  Color color(int x, int y) const;

 private:
  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// One component between sRGB and linear light, both in [0, 1].
float srgb_to_linear(float component);
float linear_to_srgb(float component);

/// The bytes of a PNG file, 8 bits a component; without an alpha channel where every pixel is opaque.
/// @throws Error for an empty image or one with a side above 32767 pixels.
std::string encode_png(const Image& image);

/// @throws Error as encode_png, or where the file cannot be written; it is then as it was.
void save_png(const Image& image, const std::filesystem::path& file);

}  // namespace eigengrasp
