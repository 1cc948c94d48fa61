// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "tiles.hpp"

#include <algorithm>
#include <cmath>

#include "eigengrasp/core/parallel.hpp"

namespace eigengrasp {

std::vector<Image> draw_tiles(const std::vector<TileScene>& scenes, const PictureOptions& options) {
  const int threads = options.threads > 0 ? options.threads : hardware_threads();
  const bool one_thread_a_tile = scenes.size() >= 2 * static_cast<std::size_t>(threads);
  RenderOptions render_options;
  render_options.width = render_options.height = options.tile;
  render_options.threads = one_thread_a_tile ? 1 : threads;
  std::vector<Image> tiles(scenes.size());
  parallel_for(scenes.size(), one_thread_a_tile ? threads : 1, [&](std::size_t i, int) {
    tiles[i] = render(scenes[i].scene, scenes[i].camera, render_options);
  });
  return tiles;
}

int sheet_columns(std::size_t n, const PictureOptions& options) {
  if (options.columns > 0) return options.columns;
  if (n <= 3) return std::max(1, static_cast<int>(n));
  return static_cast<int>(std::ceil(std::sqrt(1.25 * static_cast<double>(n)) - 1e-9));
}

std::string heading_or(const PictureOptions& options, const std::string& heading) {
  return options.heading.empty() ? heading : options.heading;
}

}  // namespace eigengrasp
