// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "text.hpp"

#include <algorithm>
#include <cstdint>

namespace eigengrasp {

namespace {

/// Length of the valid UTF-8 sequence at a place; 0 where there is none.
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(at);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  const std::size_t length = lead >= 0xF0 && lead < 0xF5 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
  if (length == 0 || lead >= 0xF5 || at + length > text.size()) return 0;
  std::uint32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
    code = (code << 6) | (byte(at + i) & 0x3FU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  return overlong || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF) ? 0 : length;
}

double width_of(cairo_t* context, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

/// Drops characters from the end until the text and an ellipsis fit.
std::string shortened(cairo_t* context, std::string text, double width) {
  static const std::string kEllipsis = "\u2026";
  while (!text.empty() && width_of(context, text + kEllipsis) > width) {
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
    if (!text.empty()) text.pop_back();
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text + kEllipsis;
}

}  // namespace

std::string valid_utf8(std::string_view text) {
  std::string valid;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    if (length == 0) {
      valid += '?';
      ++i;
    } else {
      valid.append(text, i, length);
      i += length;
    }
  }
  return valid;
}

void draw_text(cairo_t* context, const std::string& text, const TextPlace& place) {
  std::string line = valid_utf8(text);
  if (line.empty()) return;
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         place.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, place.font);
  const double wide = width_of(context, line);
  if (wide > place.width) {
    cairo_set_font_size(context, place.font * std::max(0.7, 0.98 * place.width / wide));
    if (width_of(context, line) > place.width) line = shortened(context, line, place.width);
  }
  cairo_set_source_rgb(context, place.grey, place.grey, place.grey);
  cairo_move_to(context, place.x - place.anchor * width_of(context, line), place.baseline);
  cairo_show_text(context, line.c_str());
}

}  // namespace eigengrasp
