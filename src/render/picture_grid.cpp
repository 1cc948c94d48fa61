// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/render/picture_grid.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "canvas.hpp"
#include "eigengrasp/core/error.hpp"
#include "text.hpp"

namespace eigengrasp {

namespace {

/// Sizes of the parts of a sheet [pixel].
struct Layout {
  int columns = 1;
  int rows = 1;
  int tile_width = 0;
  int tile_height = 0;
  int margin = 0;
  int gap = 0;
  double font = 0.0;  ///< of titles and captions
  int title_height = 0;
  int caption_height = 0;
  int heading_height = 0;
  int footnote_height = 0;

  int row_height() const { return title_height + tile_height + caption_height; }
  int width() const { return 2 * margin + columns * tile_width + (columns - 1) * gap; }
  int height() const {
    return 2 * margin + heading_height + rows * row_height() + (rows - 1) * gap + footnote_height;
  }
  int left(int column) const { return margin + column * (tile_width + gap); }
  int top(int row) const { return margin + heading_height + row * (row_height() + gap); }
};

bool any_text(const std::vector<std::string>& texts) {
  return std::any_of(texts.begin(), texts.end(), [](const std::string& text) { return !text.empty(); });
}

Layout lay_out(const PictureGrid& grid) {
  Layout layout;
  layout.columns = grid.columns;
  const int n = std::max(1, static_cast<int>(grid.tiles.size()));
  layout.rows = (n + grid.columns - 1) / grid.columns;
  for (const Image& tile : grid.tiles) {
    layout.tile_width = std::max(layout.tile_width, tile.width);
    layout.tile_height = std::max(layout.tile_height, tile.height);
  }
  layout.font = std::clamp(0.042 * std::max(layout.tile_width, 1), 11.0, 40.0);
  const double font = layout.font;
  layout.margin = static_cast<int>(std::lround(1.2 * font));
  layout.gap = static_cast<int>(std::lround(0.7 * font));
  layout.title_height = any_text(grid.titles) ? static_cast<int>(std::lround(1.9 * font)) : 0;
  layout.caption_height = any_text(grid.captions) ? static_cast<int>(std::lround(1.9 * font)) : 0;
  layout.heading_height = grid.heading.empty() ? 0 : static_cast<int>(std::lround(2.9 * font));
  layout.footnote_height = grid.footnote.empty() ? 0 : static_cast<int>(std::lround(2.2 * font));
  return layout;
}

void check(const PictureGrid& grid) {
  if (grid.columns < 1) fail("a sheet of {} columns, expected at least 1", grid.columns);
  for (const auto* texts : {&grid.titles, &grid.captions})
    if (!texts->empty() && texts->size() != grid.tiles.size())
      fail("a sheet of {} tiles has {} titles or captions, expected as many as tiles or none",
           grid.tiles.size(), texts->size());
}

void draw_tile_text(cairo_t* context, const PictureGrid& grid, const Layout& layout, std::size_t i) {
  const int column = static_cast<int>(i) % layout.columns;
  const int row = static_cast<int>(i) / layout.columns;
  const double center = layout.left(column) + 0.5 * layout.tile_width;
  const double width = layout.tile_width;
  const double top = layout.top(row);
  if (!grid.titles.empty())
    draw_text(context, grid.titles[i],
              {center, top + 1.25 * layout.font, width, 1.05 * layout.font, true, 0.1, 0.5});
  if (!grid.captions.empty())
    draw_text(context, grid.captions[i],
              {center, top + layout.title_height + layout.tile_height + 1.15 * layout.font, width,
               layout.font, false, 0.25, 0.5});
}

}  // namespace

Image draw_grid(const PictureGrid& grid) {
  check(grid);
  const Layout layout = lay_out(grid);
  const CanvasPtr canvas = make_canvas(layout.width(), layout.height());
  const ContextPtr context(cairo_create(canvas.get()));
  cairo_set_source_rgba(context.get(), grid.background.r, grid.background.g, grid.background.b,
                        grid.background.a);
  cairo_paint(context.get());
  for (std::size_t i = 0; i < grid.tiles.size(); ++i) {
    const int column = static_cast<int>(i) % layout.columns;
    const int row = static_cast<int>(i) / layout.columns;
    const Image& tile = grid.tiles[i];
    if (tile.empty()) continue;
    put_image(canvas.get(), tile, layout.left(column) + (layout.tile_width - tile.width) / 2,
              layout.top(row) + layout.title_height + (layout.tile_height - tile.height) / 2);
  }
  for (std::size_t i = 0; i < grid.tiles.size(); ++i) draw_tile_text(context.get(), grid, layout, i);
  const double font = layout.font;
  if (!grid.heading.empty())
    draw_text(context.get(), grid.heading,
              {static_cast<double>(layout.margin), layout.margin + 1.3 * font,
               static_cast<double>(layout.width() - 2 * layout.margin), 1.45 * font, true, 0.05, 0.0});
  if (!grid.footnote.empty())
    draw_text(context.get(), grid.footnote,
              {static_cast<double>(layout.margin), layout.height() - layout.margin - 0.3 * font,
               static_cast<double>(layout.width() - 2 * layout.margin), 0.9 * font, false, 0.4, 0.0});
  return image_of(canvas.get());
}

}  // namespace eigengrasp
