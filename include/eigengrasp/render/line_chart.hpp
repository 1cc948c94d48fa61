// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "eigengrasp/render/image.hpp"

namespace eigengrasp {

/// Curves over two axes with ticks, names and a legend.
struct LineChart {
  struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;  ///< (x, y), finite
    bool dashed = false;
  };

  std::string title, x_name, y_name;
  double x_min = 0.0, x_max = 1.0, y_min = 0.0, y_max = 1.0;  ///< of the axes; what lies outside is cut off
  std::vector<Curve> curves;
  int width = 720, height = 480;  ///< [pixel]
};

/// The chart as a picture. @throws std::logic_error where an axis has no length
Image draw_chart(const LineChart& chart);

/// The chart as the text of an SVG file.
std::string chart_svg(const LineChart& chart);

}  // namespace eigengrasp
