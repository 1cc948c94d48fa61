// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/render/line_chart.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace eigengrasp::testing {
namespace {

LineChart diagonal() {
  LineChart chart;
  chart.title = "title";
  chart.curves = {{"up", {{0.0, 0.0}, {1.0, 1.0}}, false}};
  chart.width = chart.height = 400;
  return chart;
}

TEST(LineChart, DrawsTheCurveWhereItBelongs) {
  const Image image = draw_chart(diagonal());
  ASSERT_EQ(image.width, 400);
  int blue = 0, on_the_diagonal = 0;
  for (int y = 150; y < 340; ++y)  // below the legend
    for (int x = 70; x < 375; ++x) {
      const Color c = image.color(x, y);
      if (c.b < c.r + 0.3F) continue;
      ++blue;
      const double u = (x - 64.0) / (400.0 - 84.0), v = (348.0 - y) / (400.0 - 96.0);
      on_the_diagonal += std::abs(u - v) < 0.02 ? 1 : 0;
    }
  EXPECT_GT(blue, 100);
  EXPECT_EQ(blue, on_the_diagonal);
}

TEST(LineChart, IsAlsoSvg) {
  const std::string svg = chart_svg(diagonal());
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(LineChart, AnAxisWithoutLengthIsAMistake) {
  LineChart chart = diagonal();
  chart.x_max = chart.x_min;
  EXPECT_THROW(draw_chart(chart), std::logic_error);
}

}  // namespace
}  // namespace eigengrasp::testing
