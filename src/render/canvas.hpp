// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cairo/cairo.h>

#include <memory>

#include "eigengrasp/render/image.hpp"

namespace eigengrasp {

struct SurfaceReleaser {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using CanvasPtr = std::unique_ptr<cairo_surface_t, SurfaceReleaser>;

/// An 8-bit sRGB copy of an image, ARGB32. @throws Error as encode_png.
CanvasPtr canvas_of(const Image& image);

/// Copies an image onto a canvas with its upper left corner at (x, y); what lies outside is cut off.
void put_image(cairo_surface_t* canvas, const Image& image, int x, int y);

/// The picture of an ARGB32 canvas.
Image image_of(cairo_surface_t* canvas);

/// An empty canvas. @throws Error for sides below 1 or above 32767.
CanvasPtr make_canvas(int width, int height);

}  // namespace eigengrasp
