// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Ashtray, glass and flask: bodies of revolution around z.
#include <cmath>
#include <numbers>

#include "designs.hpp"
#include "eigengrasp/modeling/operations.hpp"
#include "eigengrasp/modeling/primitives.hpp"

namespace eigengrasp::make_objects {

using namespace modeling;

namespace {

/// Outline given in millimetres as (radius, z, rounding), the ends on the axis, lifted by `lift` [mm].
struct Corner {
  double radius, z, rounding;
};

Polyline outline_of(const std::vector<Corner>& corners, double lift) {
  Polyline points;
  std::vector<double> roundings;
  for (const Corner& c : corners) {
    points.push_back({c.radius * mm, (c.z + lift) * mm});
    roundings.push_back(c.rounding * mm);
  }
  return round_corners(points, roundings, true, 0.08);
}

}  // namespace

Solid ashtray() {
  const double lift = -16.0;
  const Solid body =
      revolve(outline_of({{0, 0, 0}, {56, 0, 4}, {67, 32, 5}, {54, 32, 4}, {46, 8, 10}, {0, 8, 0}}, lift));
  Solid result = body;
  for (int i = 0; i < 4; ++i) {
    const double angle = std::numbers::pi * (0.25 + 0.5 * i);
    const Vec3 outwards(std::cos(angle), std::sin(angle), 0.0);
    // Slopes towards the bowl, so that a cigarette stays put.
    const Vec3 a = 40 * mm * outwards + Vec3(0, 0, (30 + lift) * mm);
    const Vec3 b = 82 * mm * outwards + Vec3(0, 0, (36 + lift) * mm);
    result = smooth_subtract(result, capsule(a, b, 6.0 * mm), 5.0 * mm);
  }
  return result;
}

Solid glass() {
  // Wall 2.5 mm, base 11 mm, foot slightly hollow.
  return revolve(outline_of({{0, 1.5, 0},
                             {23, 1.5, 2},
                             {26, 0, 1.5},
                             {30, 0, 3},
                             {39, 120, 1.24},
                             {36.5, 120, 1.24},
                             {28.2, 11, 7},
                             {0, 11, 0}},
                            -60.0));
}

Solid flask() {
  // Outer and inner side 3 mm apart; the lip stands out.
  return revolve(outline_of({{0, 0, 0},
                             {66, 0, 10},
                             {17, 130, 28},
                             {17, 176, 4},
                             {21.5, 182, 3.5},
                             {21.5, 188, 2.2},
                             {14, 188, 2.2},
                             {14, 129.3, 31},
                             {61.5, 4, 8},
                             {0, 4, 0}},
                            -75.0));
}

}  // namespace eigengrasp::make_objects
