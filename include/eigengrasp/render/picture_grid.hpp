// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <vector>

#include "eigengrasp/render/image.hpp"

namespace eigengrasp {

/// A sheet of pictures with text.
struct PictureGrid {
  std::vector<Image> tiles;           ///< row by row; an empty one leaves its place blank
  int columns = 1;                    ///< at least 1
  std::vector<std::string> titles;    ///< above the tiles, bold; none or one a tile
  std::vector<std::string> captions;  ///< below the tiles; none or one a tile
  std::string heading;                ///< above all; may be empty
  std::string footnote;               ///< below all; may be empty
  Color background{1.0F, 1.0F, 1.0F, 1.0F};
};

/// Composes the sheet. The text is as large as suits the tiles and gets smaller, then shortened, where it
/// is wider than its place. Text that is not UTF-8 is mended.
/// @throws Error for columns below 1, a count of titles or captions that is not that of the tiles, or a sheet
/// with a side above 32767 pixels.
Image draw_grid(const PictureGrid& grid);

}  // namespace eigengrasp
