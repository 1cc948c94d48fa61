// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

#include "eigengrasp/render/picture_grid.hpp"
#include "eigengrasp/render/pictures.hpp"

namespace eigengrasp {

/// A scene and the camera of its tile.
struct TileScene {
  RenderScene scene;
  Camera camera;
};

inline constexpr double kTileMargin = 0.06;

/// Draws square tiles, several at a time where that is quicker.
std::vector<Image> draw_tiles(const std::vector<TileScene>& scenes, const PictureOptions& options);

/// Columns of a sheet of n tiles: what the options say, else a little wider than high.
int sheet_columns(std::size_t n, const PictureOptions& options);

/// The options' heading, else the given one.
std::string heading_or(const PictureOptions& options, const std::string& heading);

}  // namespace eigengrasp
