// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <vector>

namespace eigengrasp {

/// For every pixel of a picture, row by row, the index of about the nearest one that is marked (vector
/// distance transform of Danielsson 1980: wrong by a small part of a pixel at most); -1 where none is.
/// @pre marked.size() is a multiple of columns
std::vector<int> nearest_pixels(const std::vector<char>& marked, int columns);

/// Distance of two pixels [pixels].
double pixel_distance(int a, int b, int columns);

}  // namespace eigengrasp
