// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/render/line_chart.hpp"

#include <cairo/cairo-svg.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "render/canvas.hpp"
#include "render/text.hpp"

namespace eigengrasp {

namespace {

constexpr double left = 64.0, right = 20.0, top = 44.0, bottom = 52.0;  // margins [pixel]
constexpr double font = 13.0;

struct Frame {
  const LineChart& chart;
  double x(double value) const {
    return left + (chart.width - left - right) * (value - chart.x_min) / (chart.x_max - chart.x_min);
  }
  double y(double value) const {
    return chart.height - bottom -
           (chart.height - top - bottom) * (value - chart.y_min) / (chart.y_max - chart.y_min);
  }
};

/// 1, 2 or 5 times a power of ten, so that an axis has 4 to 10 ticks.
double tick_step(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length / 4.0)));
  const double share = length / 4.0 / power;
  return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

void line(cairo_t* context, double x0, double y0, double x1, double y1, double grey) {
  cairo_set_source_rgb(context, grey, grey, grey);
  cairo_set_line_width(context, 1.0);
  cairo_move_to(context, x0, y0);
  cairo_line_to(context, x1, y1);
  cairo_stroke(context);
}

void set_color(cairo_t* context, std::size_t i) {
  // Told apart also by people who see few colours (Okabe and Ito).
  constexpr std::array<std::array<double, 3>, 6> colors{{{0.00, 0.45, 0.70},
                                                         {0.84, 0.37, 0.00},
                                                         {0.00, 0.62, 0.45},
                                                         {0.80, 0.47, 0.65},
                                                         {0.35, 0.35, 0.35},
                                                         {0.90, 0.62, 0.00}}};
  const auto& c = colors[i % colors.size()];
  cairo_set_source_rgb(context, c[0], c[1], c[2]);
}

void draw_x_axis(cairo_t* context, const Frame& f) {
  const LineChart& c = f.chart;
  const double step = tick_step(c.x_max - c.x_min);
  for (int k = 0; c.x_min + k * step <= c.x_max + 1e-9 * step; ++k) {
    const double value = c.x_min + k * step, x = f.x(value);
    line(context, x, f.y(c.y_min), x, f.y(c.y_max), 0.88);
    draw_text(context, fmt::format("{:g}", std::round(value / step * 1e6) / 1e6 * step),
              {.x = x, .baseline = c.height - bottom + 20.0, .width = 60.0, .font = font, .anchor = 0.5});
  }
  draw_text(context, c.x_name,
            {.x = 0.5 * (f.x(c.x_min) + f.x(c.x_max)),
             .baseline = c.height - 12.0,
             .width = 0.8 * c.width,
             .font = font + 1.0,
             .anchor = 0.5});
}

void draw_y_axis(cairo_t* context, const Frame& f) {
  const LineChart& c = f.chart;
  const double step = tick_step(c.y_max - c.y_min);
  for (int k = 0; c.y_min + k * step <= c.y_max + 1e-9 * step; ++k) {
    const double value = c.y_min + k * step, y = f.y(value);
    line(context, f.x(c.x_min), y, f.x(c.x_max), y, 0.88);
    draw_text(context, fmt::format("{:g}", std::round(value / step * 1e6) / 1e6 * step),
              {.x = left - 8.0, .baseline = y + 4.0, .width = left - 24.0, .font = font, .anchor = 1.0});
  }
  cairo_save(context);
  cairo_translate(context, 18.0, 0.5 * (f.y(c.y_min) + f.y(c.y_max)));
  cairo_rotate(context, -std::acos(0.0));
  draw_text(context, c.y_name,
            {.x = 0.0, .baseline = 0.0, .width = 0.8 * c.height, .font = font + 1.0, .anchor = 0.5});
  cairo_restore(context);
}

void draw_curve(cairo_t* context, const Frame& f, std::size_t i) {
  const LineChart::Curve& curve = f.chart.curves[i];
  constexpr double dash = 6.0;
  cairo_save(context);
  cairo_rectangle(context, left, top, f.chart.width - left - right, f.chart.height - top - bottom);
  cairo_clip(context);
  set_color(context, i);
  cairo_set_line_width(context, 2.2);
  if (curve.dashed) cairo_set_dash(context, &dash, 1, 0.0);
  for (const auto& [x, y] : curve.points) cairo_line_to(context, f.x(x), f.y(y));
  cairo_stroke(context);
  cairo_restore(context);
}

void draw_legend(cairo_t* context, const Frame& f) {
  constexpr double dash = 6.0;
  for (std::size_t i = 0; i < f.chart.curves.size(); ++i) {
    const double y = top + 18.0 + 19.0 * static_cast<double>(i), x = f.chart.width - right - 12.0;
    set_color(context, i);
    cairo_set_line_width(context, 2.2);
    if (f.chart.curves[i].dashed) cairo_set_dash(context, &dash, 1, 0.0);
    cairo_move_to(context, x - 30.0, y - 4.0);
    cairo_line_to(context, x, y - 4.0);
    cairo_stroke(context);
    cairo_set_dash(context, nullptr, 0, 0.0);
    draw_text(context, f.chart.curves[i].name,
              {.x = x - 38.0, .baseline = y, .width = 0.6 * f.chart.width, .font = font, .anchor = 1.0});
  }
}

void draw_all(cairo_t* context, const LineChart& chart) {
  if (!(chart.x_max > chart.x_min) || !(chart.y_max > chart.y_min))
    throw std::logic_error("an axis of a chart has no length");
  const Frame f{chart};
  cairo_set_source_rgb(context, 1.0, 1.0, 1.0);
  cairo_paint(context);
  draw_x_axis(context, f);
  draw_y_axis(context, f);
  line(context, f.x(chart.x_min), f.y(chart.y_min), f.x(chart.x_max), f.y(chart.y_min), 0.2);
  line(context, f.x(chart.x_min), f.y(chart.y_min), f.x(chart.x_min), f.y(chart.y_max), 0.2);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) draw_curve(context, f, i);
  draw_legend(context, f);
  draw_text(context, chart.title,
            {.x = 0.5 * chart.width,
             .baseline = 26.0,
             .width = 0.9 * chart.width,
             .font = font + 3.0,
             .bold = true,
             .anchor = 0.5});
}

}  // namespace

Image draw_chart(const LineChart& chart) {
  const CanvasPtr canvas = make_canvas(chart.width, chart.height);
  const ContextPtr context(cairo_create(canvas.get()));
  draw_all(context.get(), chart);
  cairo_surface_flush(canvas.get());
  return image_of(canvas.get());
}

std::string chart_svg(const LineChart& chart) {
  std::string text;
  const auto append = [](void* to, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  {
    const CanvasPtr canvas(cairo_svg_surface_create_for_stream(append, &text, chart.width, chart.height));
    const ContextPtr context(cairo_create(canvas.get()));
    draw_all(context.get(), chart);
    cairo_surface_finish(canvas.get());
  }
  return text;
}

}  // namespace eigengrasp
