// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Low laced shoe of a right foot: x towards the toe, y towards the inner side, z up, drawn from the ground.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "designs.hpp"
#include "eigengrasp/modeling/operations.hpp"
#include "eigengrasp/modeling/primitives.hpp"

namespace eigengrasp::make_objects {

using namespace modeling;

namespace {

/// The shoe at one station [mm]: sides of the sole, top of the upper.
struct Station {
  double x, inner, outer, top;
};

constexpr Station stations[] = {{-106, 31, -31, 118}, {-75, 32, -33, 118}, {-35, 29, -36, 116},
                                {-10, 31, -39, 104},  {15, 38, -43, 84},   {45, 46, -46, 67},
                                {75, 46.5, -44, 56},  {100, 40, -34, 50}};
constexpr double heel_end = 29.0, toe_end = 35.0;  // rounded ends beyond the first and the last station [mm]
constexpr int end_steps = 16;                      // sections of a rounded end
constexpr double welt = 3.5;                       // the sole stands out beyond the upper [mm]
constexpr double wall = 4.5;                       // of the upper [mm]

/// Height [mm] of the underside of the sole over the ground: the toe springs, the heel stands on its block.
double lift(double x) {
  const double toe = std::clamp((x - 60.0) / 75.0, 0.0, 1.0), heel = std::clamp((10.0 - x) / 70.0, 0.0, 1.0);
  return 11.0 * toe * toe + 13.0 * heel * heel * (3.0 - 2.0 * heel);
}

Solid lifted(const Solid& flat) {
  Solid bent{[flat](const Vec3& p) { return flat(Vec3(p.x(), p.y(), p.z() - lift(p.x() / mm) * mm)); },
             flat.box};
  bent.box.max.z() += 15.0 * mm;
  return bent;
}

/// Sections of the upper; `inset` [mm] from the sides of the sole, its top `sink` [mm] lower than the
/// upper's.
std::vector<Section> upper_sections(double inset, double sink = 0.0) {
  std::vector<Section> s;
  const auto add = [&](double x, const Station& at, double narrow, double low) {
    const double base = lift(x) + 8.0;
    const double width = std::max(0.5 * (at.inner - at.outer) * narrow - inset, 0.6);
    s.push_back({x * mm, 0.5 * (at.inner + at.outer) * mm, base * mm, width * mm,
                 std::max((at.top - base) * low - sink, 2.0) * mm, 9.0 * mm, 2.5});
  };
  for (int i = end_steps; i > 0; --i) {
    const double angle = 0.5 * std::numbers::pi * i / end_steps;
    add(stations[0].x - (heel_end - inset) * std::sin(angle), stations[0], std::cos(angle), 1.0);
  }
  for (const Station& at : stations) add(at.x, at, 1.0, 1.0);
  const Station& last = stations[std::size(stations) - 1];
  for (int i = 1; i <= end_steps; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / end_steps;
    Station at = last;
    at.inner += 2.0 * std::sin(angle);
    at.outer += 6.0 * std::sin(angle);
    at.top -= 6.0 * std::sin(angle);
    add(last.x + (toe_end - inset) * std::sin(angle), at, std::cos(angle), std::pow(std::cos(angle), 0.6));
  }
  return s;
}

/// Outline of the sole, the part of it up to x_end [mm].
Polyline sole_outline(double x_end) {
  const std::vector<Section> s = upper_sections(0.0);
  Polyline outline;
  for (const Section& at : s) {
    if (at.x <= x_end * mm) outline.push_back({at.x, at.center_y - at.half_width});
  }
  for (std::size_t i = s.size(); i-- > 0;) {
    if (s[i].x <= x_end * mm) outline.push_back({s[i].x, s[i].center_y + s[i].half_width});
  }
  return outline;
}

Solid bottom() {
  const Solid sole = lifted(extrude(sole_outline(1000.0), 0.0, 10.0 * mm, 2.5 * mm));
  // The heel block reaches into the sole; its front is hollowed a little.
  Solid heel = extrude(sole_outline(-60.0), 0.0, 18.0 * mm, 1.6 * mm);
  const Solid hollow = cylinder(Vec3(-30, 0, -20) * mm, Vec3(-30, 0, 14) * mm, 34.0 * mm);
  heel = smooth_subtract(heel, hollow, 2.0 * mm);
  return smooth_unite(sole, heel, 3.0 * mm);
}

/// What is cut away above the collar: outline in (x, z), extruded across the shoe.
Solid above_collar() {
  Polyline line{{-160, 92}, {-136, 87}, {-120, 80}, {-95, 71}, {-70, 67.5},
                {-45, 72},  {-25, 83},  {-10, 97},  {4, 125}};
  Polyline outline = smooth_curve(line, 8);
  outline.push_back({4, 160});
  outline.push_back({-160, 160});
  for (Point2& p : outline) p = {p[0] * mm, p[1] * mm};
  Pose turn = Pose::Identity();  // (x, z) of the outline, extruded towards -y
  turn.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return move(extrude(outline, -80.0 * mm, 80.0 * mm), turn);
}

/// Room of the foot: the upper, a wall thinner, above the insole.
Solid room() {
  const Solid inner = sweep(upper_sections(welt + wall, wall + 2.0));
  const Solid floor{[](const Vec3& p) { return (lift(p.x() / mm) + 12.0) * mm - p.z(); }, inner.box};
  // Blunt in front: the distance to a narrow end is a poor one.
  const Solid front = half_space(Vec3(117, 0, 0) * mm, Vec3::UnitX(), inner.box);
  return smooth_intersect(smooth_intersect(inner, front, 8.0 * mm), floor, 8.0 * mm);
}

/// Vertical prism over a rectangle [mm], corners rounded.
Solid band(double x, double y, double length, double width, double corner) {
  const double a = 0.5 * length * mm, b = 0.5 * width * mm, r = corner * mm;
  const double u = x * mm, v = y * mm;
  return extrude(
      round_corners({{u - a, v - b}, {u + a, v - b}, {u + a, v + b}, {u - a, v + b}}, {r, r, r, r}),
      40.0 * mm, 150.0 * mm);
}

Solid raised(const Solid& skin, const Solid& where, double height, double round) {
  return smooth_intersect(inflate(skin, height * mm), where, round * mm);
}

/// Facings beside the throat and laces across it, as raised parts of the upper.
Solid trimmings(const Solid& upper) {
  std::vector<Solid> laces;
  for (int i = 0; i < 5; ++i) laces.push_back(band(-2.0 + 12.5 * i, -1.0 + 0.5 * i, 5.0, 33.0, 2.2));
  const Solid trim = raised(upper, unite(laces), 3.6, 3.0);
  const Solid facing = subtract(band(22, 0, 72, 52, 16), band(30, 0, 72, 17, 8));
  return smooth_unite(trim, raised(upper, facing, 1.6, 2.0), 1.5 * mm);
}

/// Toe cap and heel counter: the upper once more, a little thicker, up to their seams.
Solid caps() {
  const Solid thicker = sweep(upper_sections(welt - 1.3, -1.3));
  const Box& all = thicker.box;
  const Solid cap = subtract(half_space(Vec3(92, 0, 0) * mm, Vec3(-1, 0, 0), all),
                             cylinder(Vec3(40, 2, -50) * mm, Vec3(40, 2, 200) * mm, 57.0 * mm));
  const Solid counter = half_space(Vec3(-88, 0, 0) * mm, Vec3(1, 0, -0.35), all);  // around the heel
  return unite(smooth_intersect(thicker, cap, 2.0 * mm), smooth_intersect(thicker, counter, 2.0 * mm));
}

}  // namespace

Solid shoe() {
  const Solid upper = sweep(upper_sections(welt));
  const Solid outside = smooth_unite(smooth_unite(upper, trimmings(upper), 1.5 * mm), caps(), 0.8 * mm);
  Solid shoe = smooth_unite(outside, bottom(), 1.5 * mm);
  // Nothing of the upper below the sole.
  const Solid underside{[](const Vec3& p) { return (lift(p.x() / mm) + 4.0) * mm - p.z(); }, upper.box};
  shoe = unite(intersect(shoe, underside), bottom());
  shoe.box = bottom().box;
  shoe.box.add(outside.box);
  shoe = smooth_subtract(shoe, above_collar(), 3.0 * mm);
  shoe = smooth_subtract(shoe, room(), 2.0 * mm);
  return move(shoe, Vec3(0, 0, -45) * mm);
}

}  // namespace eigengrasp::make_objects
