// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <cairo/cairo.h>

#include <memory>
#include <string>
#include <string_view>

namespace eigengrasp {

struct ContextReleaser {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using ContextPtr = std::unique_ptr<cairo_t, ContextReleaser>;

/// Where and how a line of text stands.
struct TextPlace {
  double x = 0.0;         ///< anchor [pixel]
  double baseline = 0.0;  ///< [pixel]
  double width = 0.0;     ///< most that it may take [pixel]
  double font = 12.0;     ///< [pixel]
  bool bold = false;
  double grey = 0.0;    ///< 0: black
  double anchor = 0.0;  ///< share of the text that stands left of x
};

/// Draws a line; where it is too wide, first smaller (down to 0.7), then shortened with an ellipsis.
void draw_text(cairo_t* context, const std::string& text, const TextPlace& place);

/// The text with every byte that is not part of a valid UTF-8 sequence, and every control character, replaced
/// by a question mark.
std::string valid_utf8(std::string_view text);

}  // namespace eigengrasp
