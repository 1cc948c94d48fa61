// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Cordless handset, lying on its back: x along it towards the antenna, y across, z out of the front.
#include "designs.hpp"
#include "eigengrasp/modeling/operations.hpp"
#include "eigengrasp/modeling/primitives.hpp"

namespace eigengrasp::make_objects {

using namespace modeling;

namespace {

/// Body like a shallow arc: both ends rise towards the face, the waist is a little narrower.
Solid body() {
  std::vector<Section> sections;
  const auto add = [&](double x, double half_width, double center_z, double up, double down) {
    sections.push_back({x * mm, 0.0, center_z * mm, half_width * mm, up * mm, down * mm, 3.6});
  };
  add(-62, 25.0, 2.6, 11.0, 11.0);
  add(-40, 26.0, 0.8, 11.0, 11.5);
  add(0, 25.0, -0.6, 11.0, 12.0);
  add(35, 26.0, 0.4, 11.0, 12.5);
  add(61, 26.0, 2.4, 11.0, 12.0);
  // Blunt, well rounded ends.
  std::vector<Section> low = round_end(sections.front(), -13.0 * mm),
                       high = round_end(sections.back(), 14.0 * mm);
  low.insert(low.end(), sections.begin(), sections.end());
  low.insert(low.end(), high.begin(), high.end());
  return sweep(low);
}

/// Upright prism with rounded corners over a rectangle of the face [mm].
Solid column(double x, double y, double length, double width, double corner) {
  Box box;
  const double a = 0.5 * length, b = 0.5 * width;
  const Polyline outline = round_corners({{(x - a) * mm, (y - b) * mm},
                                          {(x + a) * mm, (y - b) * mm},
                                          {(x + a) * mm, (y + b) * mm},
                                          {(x - a) * mm, (y + b) * mm}},
                                         {corner * mm, corner * mm, corner * mm, corner * mm});
  return extrude(outline, 2.0 * mm, 40.0 * mm);
}

/// The part of the column that lies deeper than `depth` [mm] under the skin is left alone, the rest goes.
Solid sink(const Solid& solid, const Solid& skin, const Solid& where, double depth) {
  Solid outside{[skin, depth](const Vec3& p) { return -(skin(p) + depth * mm); }, where.box};
  return smooth_subtract(solid, smooth_intersect(where, outside, 1.5 * mm), 1.5 * mm);
}

/// The skin stands out by `height` [mm] within the column.
Solid raise(const Solid& solid, const Solid& skin, const Solid& where, double height) {
  return smooth_unite(solid, smooth_intersect(inflate(skin, height * mm), where, 2.5 * mm), 1.2 * mm);
}

}  // namespace

Solid phone() {
  const Solid skin = body();
  Solid phone = sink(skin, skin, column(27, 0, 26, 36, 4), 1.2);  // display
  phone = sink(phone, skin, column(59, 0, 5, 22, 2.4), 1.5);      // ear piece
  phone = sink(phone, skin, column(-65, 0, 3.4, 12, 1.6), 1.3);   // microphone
  phone = raise(phone, skin, column(6, 0, 8, 16, 3.5), 1.6);      // wide key
  phone = raise(phone, skin, column(6, -15.5, 7, 9, 3), 1.4);
  phone = raise(phone, skin, column(6, 15.5, 7, 9, 3), 1.4);
  std::vector<Solid> keys;
  for (int row = 0; row < 4; ++row) {
    for (int k = -1; k <= 1; ++k) keys.push_back(column(-8.0 - 13.0 * row, 14.0 * k, 8.0, 10.5, 3.2));
  }
  phone = raise(phone, skin, unite(keys), 1.5);
  const Solid antenna = unite(round_cone(Vec3(60, 17, 1) * mm, 6.5 * mm, Vec3(98, 17, 3) * mm, 4.6 * mm),
                              sphere(Vec3(100, 17, 3.2) * mm, 5.4 * mm));
  phone = smooth_unite(phone, antenna, 4.0 * mm);
  return move(phone, Vec3(-8, 0, 0) * mm);
}

}  // namespace eigengrasp::make_objects
