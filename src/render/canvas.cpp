// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"

namespace eigengrasp {

namespace {

constexpr int kLargestSide = 32767;  // of Cairo
constexpr int kSteps = 4096;

/// 8-bit sRGB of linear light in [0, 1].
std::uint32_t byte_of(float component) {
  static const auto table = [] {
    std::array<std::uint8_t, kSteps + 1> t{};
    for (int i = 0; i <= kSteps; ++i)
      t[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(255.0F * linear_to_srgb(static_cast<float>(i) / kSteps)));
    return t;
  }();
  const float c = std::clamp(component, 0.0F, 1.0F);
  return table[static_cast<std::size_t>(std::lround(c * kSteps))];
}

float component_of(std::uint32_t byte) {
  static const auto table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = srgb_to_linear(static_cast<float>(i) / 255.0F);
    return t;
  }();
  return table[byte & 0xFFU];
}

std::uint32_t pack(const float* rgba) {
  const float alpha = std::clamp(rgba[3], 0.0F, 1.0F);
  if (alpha <= 0.0F) return 0;
  const auto a = static_cast<std::uint32_t>(std::lround(255.0F * alpha));
  std::uint32_t word = a << 24;
  for (int k = 0; k < 3; ++k) {
    const auto straight = static_cast<float>(byte_of(rgba[k] / alpha));
    word |= static_cast<std::uint32_t>(std::lround(straight * alpha)) << (8 * (2 - k));
  }
  return word;
}

void unpack(std::uint32_t word, float* rgba) {
  const std::uint32_t a = word >> 24;
  rgba[3] = static_cast<float>(a) / 255.0F;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t c = (word >> (8 * (2 - k))) & 0xFFU;
    rgba[k] = a == 255 ? component_of(c)
                       : (a == 0 ? 0.0F : component_of(std::min(255U, (c * 255U + a / 2) / a)) * rgba[3]);
  }
}

std::uint32_t* row_of(cairo_surface_t* canvas, int y) {
  unsigned char* data = cairo_image_surface_get_data(canvas);
  return reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) *
                                                     cairo_image_surface_get_stride(canvas));
}

cairo_status_t append_bytes(void* closure, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

float srgb_to_linear(float component) {
  return component <= 0.04045F ? component / 12.92F : std::pow((component + 0.055F) / 1.055F, 2.4F);
}

float linear_to_srgb(float component) {
  return component <= 0.0031308F ? 12.92F * component : 1.055F * std::pow(component, 1.0F / 2.4F) - 0.055F;
}

Image::Image(int w, int h, const Color& color) : width(w), height(h) {
  const std::array<float, 4> pixel_value = {color.a * srgb_to_linear(color.r),
                                            color.a * srgb_to_linear(color.g),
                                            color.a * srgb_to_linear(color.b), color.a};
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  rgba.reserve(4 * count);
  for (std::size_t i = 0; i < count; ++i) rgba.insert(rgba.end(), pixel_value.begin(), pixel_value.end());
}

Color Image::color(int x, int y) const {
  const float* p = pixel(x, y);
  if (p[3] <= 0.0F) return {0.0F, 0.0F, 0.0F, 0.0F};
  return {linear_to_srgb(p[0] / p[3]), linear_to_srgb(p[1] / p[3]), linear_to_srgb(p[2] / p[3]), p[3]};
}

CanvasPtr make_canvas(int width, int height) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    fail("a picture of {} x {} pixels, expected sides of 1 to {}", width, height, kLargestSide);
  CanvasPtr canvas(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
  if (cairo_surface_status(canvas.get()) != CAIRO_STATUS_SUCCESS)
    fail("a picture of {} x {} pixels: {}", width, height,
         cairo_status_to_string(cairo_surface_status(canvas.get())));
  return canvas;
}

void put_image(cairo_surface_t* canvas, const Image& image, int x, int y) {
  cairo_surface_flush(canvas);
  const int width = cairo_image_surface_get_width(canvas);
  const int height = cairo_image_surface_get_height(canvas);
  for (int j = std::max(0, -y); j < image.height && y + j < height; ++j) {
    std::uint32_t* row = row_of(canvas, y + j);
    for (int i = std::max(0, -x); i < image.width && x + i < width; ++i) row[x + i] = pack(image.pixel(i, j));
  }
  cairo_surface_mark_dirty(canvas);
}

CanvasPtr canvas_of(const Image& image) {
  CanvasPtr canvas = make_canvas(image.width, image.height);
  put_image(canvas.get(), image, 0, 0);
  return canvas;
}

Image image_of(cairo_surface_t* canvas) {
  cairo_surface_flush(canvas);
  Image image(cairo_image_surface_get_width(canvas), cairo_image_surface_get_height(canvas), Color{});
  for (int y = 0; y < image.height; ++y) {
    const std::uint32_t* row = row_of(canvas, y);
    for (int x = 0; x < image.width; ++x) unpack(row[x], image.pixel(x, y));
  }
  return image;
}

std::string encode_png(const Image& image) {
  CanvasPtr canvas = canvas_of(image);
  bool opaque = true;
  for (std::size_t i = 3; i < image.rgba.size() && opaque; i += 4) opaque = image.rgba[i] >= 1.0F;
  if (opaque) {  // the same pixels without the alpha channel
    CanvasPtr rgb(cairo_image_surface_create_for_data(cairo_image_surface_get_data(canvas.get()),
                                                      CAIRO_FORMAT_RGB24, image.width, image.height,
                                                      cairo_image_surface_get_stride(canvas.get())));
    std::string bytes;
    const cairo_status_t status = cairo_surface_write_to_png_stream(rgb.get(), append_bytes, &bytes);
    if (status != CAIRO_STATUS_SUCCESS)
      fail("the picture cannot be encoded ({})", cairo_status_to_string(status));
    return bytes;
  }
  std::string bytes;
  const cairo_status_t status = cairo_surface_write_to_png_stream(canvas.get(), append_bytes, &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    fail("the picture cannot be encoded ({})", cairo_status_to_string(status));
  return bytes;
}

void save_png(const Image& image, const std::filesystem::path& file) {
  write_file_atomically(file, encode_png(image));
}

}  // namespace eigengrasp
