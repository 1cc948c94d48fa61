// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/database/graspable_size.hpp"

#include <algorithm>
#include <cmath>

namespace eigengrasp {

namespace {

constexpr double kMiddleSide = 0.07;  // [m]
constexpr double kLongestSide = 0.25;

struct Sides {
  double middle, longest;
};

Sides sides_of(const Box& box) {
  Vec3 size = box.size();
  std::sort(size.begin(), size.end());
  return {size[1], size[2]};
}

/// Sums of area, area times distance, area times squared distance.
struct Moments {
  double area = 0.0, first = 0.0, second = 0.0;
};

/// Cuts a triangle into n * n equal ones, and takes each at its centroid.
void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, int n, Moments& sum) {
  const Vec3 u = (b - a) / n, v = (c - a) / n;
  const double piece = 0.5 * u.cross(v).norm();
  const auto add = [&](double i, double j) {
    const double d = (a + i * u + j * v).norm();
    sum.area += piece;
    sum.first += piece * d;
    sum.second += piece * d * d;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < n) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
}

}  // namespace

double graspable_rescale(const Box& box) {
  const Sides s = sides_of(box);
  const double by_longest = kLongestSide / s.longest;
  return s.middle > 0.0 ? std::min(kMiddleSide / s.middle, by_longest) : by_longest;
}

bool is_graspable(const Box& box) {
  const Sides s = sides_of(box);
  return s.middle >= 0.01 && s.middle <= 0.15 && s.longest >= 0.03 && s.longest <= 0.4;
}

double approximate_radius(const TriangleMesh& mesh, const Vec3& center) {
  const double longest_piece = bounding_box(mesh).diagonal() / 50.0;
  Moments sum;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - center, b = mesh.corner(t, 1) - center, c = mesh.corner(t, 2) - center;
    const double edge = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    add_triangle(a, b, c, std::max(1, static_cast<int>(std::ceil(edge / longest_piece))), sum);
  }
  const double mean = sum.first / sum.area;
  return mean + 2.0 * std::sqrt(std::max(0.0, sum.second / sum.area - mean * mean));
}

}  // namespace eigengrasp
