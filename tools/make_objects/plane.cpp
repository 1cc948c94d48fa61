// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Toy fighter of the second world war: x towards the nose, y towards the left wing tip, z up.
#include <cmath>
#include <numbers>

#include "designs.hpp"
#include "eigengrasp/modeling/operations.hpp"
#include "eigengrasp/modeling/primitives.hpp"

namespace eigengrasp::make_objects {

using namespace modeling;

namespace {

/// Sweeps along x, given for x in millimetres.
Section at(double x, double center_z, double half_width, double up, double down, double exponent = 2.2) {
  return {x * mm, 0.0, center_z * mm, half_width * mm, up * mm, down * mm, exponent};
}

Solid fuselage() {
  std::vector<Section> middle{at(-92, 7.0, 3.2, 4.0, 4.5),    at(-65, 4.5, 6.0, 7.5, 8.0),
                              at(-30, 1.5, 10.0, 12.0, 12.0), at(10, 0.0, 12.0, 13.5, 13.0),
                              at(45, 0.0, 12.0, 12.5, 13.0),  at(78, 0.0, 9.8, 10.5, 11.0)};
  std::vector<Section> all = round_end(middle.front(), -5.0 * mm);
  all.insert(all.end(), middle.begin(), middle.end());
  return sweep(all);
}

/// Spinner: a blunt cone ahead of the cowling.
Solid spinner() {
  std::vector<Section> all{at(70, 0.0, 9.4, 9.4, 9.4, 2.0), at(79, 0.0, 9.2, 9.2, 9.2, 2.0)};
  for (const Section& s : round_end(all.back(), 21.0 * mm, 10)) all.push_back(s);
  return sweep(all);
}

Solid propeller() {
  std::vector<Solid> blades;
  for (int i = 0; i < 4; ++i) {
    const double angle = std::numbers::pi * (0.25 + 0.5 * i);
    // Blade along z: thick enough to keep its shape, wider in the middle, turned a little around its axis.
    std::vector<Section> s;
    const auto add = [&](double x, double a, double b) {
      s.push_back({x * mm, 0, 0, a * mm, b * mm, b * mm, 2.0});
    };
    add(2, 3.0, 2.8);
    add(12, 3.7, 2.2);
    add(24, 4.7, 1.9);
    for (const Section& tip : round_end(s.back(), 10.0 * mm)) s.push_back(tip);
    const Pose X_blade(Eigen::AngleAxisd(angle, Vec3::UnitX()) *
                       Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitY()) *
                       Eigen::AngleAxisd(0.9, Vec3::UnitX()));
    blades.push_back(move(move(sweep(s), X_blade), Vec3(84, 0, 0) * mm));
  }
  return unite(blades);
}

/// Half of a flying surface in millimetres: from the root to the tip along the span.
struct Panel {
  double span, root_chord, tip_chord;    // [mm]
  double root_thickness, tip_thickness;  // [mm]
  double root_x, tip_x;                  // middle of the chord along the fuselage [mm]
  double rise;                           // of the tip over the root [mm]
};

/// Sections of one panel from the root outwards; sign_x is the sign of the fuselage direction along the
/// section.
std::vector<Section> panel_sections(const Panel& w, double sign_x) {
  std::vector<Section> s;
  const double straight = w.span - 0.35 * w.tip_chord;
  const auto add = [&](double x) {
    const double t = x / w.span;
    const double a = 0.5 * (w.root_chord + t * (w.tip_chord - w.root_chord));
    const double b = 0.5 * (w.root_thickness + t * (w.tip_thickness - w.root_thickness));
    const double middle = w.root_x + t * (w.tip_x - w.root_x);
    s.push_back({x * mm, sign_x * middle * mm, t * w.rise * mm, a * mm, b * mm, b * mm, 2.5});
  };
  for (int i = 0; i <= 6; ++i) add(straight * i / 6.0);
  for (const Section& tip : round_end(s.back(), (w.span - straight) * mm)) s.push_back(tip);
  return s;
}

/// Left and right panel as one sweep along y.
Solid wing(const Panel& w) {
  const std::vector<Section> left = panel_sections(w, -1.0);
  std::vector<Section> all;
  for (std::size_t i = left.size() - 1; i > 0; --i) {
    Section s = left[i];
    s.x = -s.x;
    all.push_back(s);
  }
  all.insert(all.end(), left.begin(), left.end());
  // Along x becomes along y, across becomes -x.
  return move(sweep(all), Pose(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ())));
}

/// Upright panel: along x becomes along z, across becomes x, thickness becomes y.
Solid fin(const Panel& w) {
  Pose turn = Pose::Identity();
  turn.linear() << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return move(sweep(panel_sections(w, 1.0)), turn);
}

}  // namespace

Solid plane() {
  Solid plane = smooth_unite(fuselage(), spinner(), 1.5 * mm);
  const Solid canopy = move(ellipsoid(Vec3::Zero(), Vec3(27, 8, 11) * mm), Vec3(-4, 0, 11) * mm);
  plane = smooth_unite(plane, canopy, 3.0 * mm);
  // Radiator scoop under the cockpit.
  const Solid scoop = ellipsoid(Vec3(-18, 0, -12) * mm, Vec3(32, 7.5, 7.5) * mm);
  plane = smooth_unite(plane, scoop, 4.0 * mm);
  const Solid main_wing = move(wing({115, 58, 30, 10.5, 6.5, 18, 13, 7}), Vec3(0, 0, -8) * mm);
  plane = smooth_unite(plane, main_wing, 7.0 * mm);
  plane =
      smooth_unite(plane, move(wing({42, 27, 18, 6.0, 4.6, -80, -83, 0}), Vec3(0, 0, 8.5) * mm), 4.0 * mm);
  plane = smooth_unite(plane, move(fin({34, 36, 17, 6.0, 4.2, -79, -89, 0}), Vec3(0, 0, 7) * mm), 4.0 * mm);
  plane = smooth_unite(plane, propeller(), 1.5 * mm);
  return plane;
}

}  // namespace eigengrasp::make_objects
