// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>

#include "eigengrasp/render/image.hpp"

namespace eigengrasp {

/// A picture of a result, and where it is to be written.
struct ResultPicture {
  std::string file;  ///< relative to the folder of the result, such as "table2/figure2.png"
  std::string caption;
  Image image;
};

}  // namespace eigengrasp
