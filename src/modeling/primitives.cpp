// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/modeling/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eigengrasp::modeling {
namespace {

void require(bool condition, const char* sentence) {
  if (!condition) throw std::logic_error(sentence);
}

Box box_around(const Vec3& center, const Vec3& half) {
  Box box;
  box.min = center - half;
  box.max = center + half;
  return box;
}

/// Slopes of a monotone cubic through (x, y) (Fritsch and Carlson 1980, with the mean of Fritsch and
/// Butland).
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> secant(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  slope.front() = secant.front();
  slope.back() = secant.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = secant[i - 1], b = secant[i];
    if (a * b <= 0.0) continue;
    const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
    slope[i] = 3.0 * (h0 + h1) / ((2.0 * h1 + h0) / a + (h1 + 2.0 * h0) / b);
  }
  return slope;
}

using Numbers = std::array<double, 6>;  // center_y, center_z, half_width, half_up, half_down, exponent

Numbers numbers_of(const Section& s) {
  return {s.center_y, s.center_z, s.half_width, s.half_up, s.half_down, s.exponent};
}

/// The sections as six monotone cubics of x.
struct SectionCurves {
  std::vector<double> x;
  std::vector<Numbers> value, slope;

  explicit SectionCurves(const std::vector<Section>& sections) {
    for (const Section& s : sections) {
      x.push_back(s.x);
      value.push_back(numbers_of(s));
    }
    slope.resize(x.size());
    std::vector<double> y(x.size());
    for (std::size_t k = 0; k < 6; ++k) {
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = value[i][k];
      const std::vector<double> m = monotone_slopes(x, y);
      for (std::size_t i = 0; i < x.size(); ++i) slope[i][k] = m[i];
    }
  }

  /// Values and their derivatives [1/m] at station s.
  void at(double s, Numbers& r, Numbers& dr) const {
    const bool between = s > x.front() && s < x.back();
    s = std::clamp(s, x.front(), x.back());
    const auto upper = std::upper_bound(x.begin() + 1, x.end() - 1, s);
    const std::size_t i = static_cast<std::size_t>(upper - x.begin()) - 1;
    const double h = x[i + 1] - x[i], t = (s - x[i]) / h, u = 1.0 - t;
    const double a = (1.0 + 2.0 * t) * u * u, b = t * u * u * h, c = t * t * (3.0 - 2.0 * t),
                 d = -t * t * u * h;
    const double da = -6.0 * t * u / h, db = u * (1.0 - 3.0 * t), dd = t * (3.0 * t - 2.0);
    for (std::size_t k = 0; k < 6; ++k) {
      r[k] = a * value[i][k] + b * slope[i][k] + c * value[i + 1][k] + d * slope[i + 1][k];
      dr[k] = between ? da * (value[i][k] - value[i + 1][k]) + db * slope[i][k] + dd * slope[i + 1][k] : 0.0;
    }
  }

  /// With rho = 1 on the outline of the section and homogeneous of degree 1 around its centre: the zero set
  /// of F = (rho^2 - 1) s^2, s the smaller half size, which stays smooth where a round end shrinks to a
  /// point.
  double distance(const Vec3& p) const {
    Numbers v, dv;
    at(p.x(), v, dv);
    const std::size_t half = p.z() >= v[1] ? 3 : 4;
    const double n = v[5], sign_y = p.y() >= v[0] ? 1.0 : -1.0, sign_z = half == 3 ? 1.0 : -1.0;
    const double y = sign_y * (p.y() - v[0]) / v[2] + 1e-9, z = sign_z * (p.z() - v[1]) / v[half];
    const double top = std::max(y, z);
    const double rho = top * std::pow(std::pow(y / top, n) + std::pow(z / top, n), 1.0 / n);
    const double gy = std::pow(y / rho, n - 1.0) / v[2], gz = std::pow(z / rho, n - 1.0) / v[half];
    const double gx = -gy * (sign_y * dv[0] + y * dv[2]) - gz * (sign_z * dv[1] + z * dv[half]);
    double inverse = 0.0, growth = 0.0;
    for (std::size_t k = 2; k < 5; ++k) {
      inverse += 1.0 / (v[k] * v[k]);
      growth += dv[k] / (v[k] * v[k] * v[k]);
    }
    const double s = 1.0 / std::sqrt(inverse), ds = s * s * s * growth, F = (rho * rho - 1.0) * s * s;
    const double Fx = 2.0 * rho * gx * s * s + 2.0 * (rho * rho - 1.0) * s * ds;
    const double steep = std::hypot(Fx, 2.0 * rho * s * s * std::hypot(gy, gz));
    // Inside, the square root keeps the value finite at the centre line, where the slope vanishes.
    const double side = F > 0.0 ? F / steep : F / (0.5 * steep + std::sqrt(0.25 * steep * steep - F));
    return std::max({side, x.front() - p.x(), p.x() - x.back()});
  }
};

}  // namespace

Solid sphere(const Vec3& center, double radius) {
  return {[center, radius](const Vec3& p) { return (p - center).norm() - radius; },
          box_around(center, Vec3::Constant(radius))};
}

Solid rounded_box(const Vec3& center, const Vec3& size, double radius) {
  const Vec3 half = 0.5 * size;
  require(radius >= 0.0 && radius <= half.minCoeff() * (1.0 + 1e-9), "rounded_box: the radius does not fit");
  const Vec3 core = half.array() - radius;
  return {[center, core, radius](const Vec3& p) {
            const Vec3 q = (p - center).cwiseAbs() - core;
            return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
          },
          box_around(center, half)};
}

Solid capsule(const Vec3& a, const Vec3& b, double radius) {
  return round_cone(a, radius, b, radius);
}

Solid round_cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
  const Vec3 axis = b - a;
  const double length = axis.norm();
  if (length <= std::abs(radius_a - radius_b))
    return radius_a > radius_b ? sphere(a, radius_a) : sphere(b, radius_b);
  Box box = box_around(a, Vec3::Constant(radius_a));
  box.add(box_around(b, Vec3::Constant(radius_b)));
  const Vec3 u = axis / length;
  const double sine = (radius_a - radius_b) / length, cosine = std::sqrt(1.0 - sine * sine);
  return {[=](const Vec3& p) {
            const double along = (p - a).dot(u);
            const double off = (p - a - along * u).norm();
            // The foot on the axis of the normal of the cone.
            const double foot = std::clamp(along + off * sine / cosine, 0.0, length);
            const double r = radius_a + (radius_b - radius_a) * foot / length;
            return std::hypot(along - foot, off) - r;
          },
          box};
}

Solid cylinder(const Vec3& a, const Vec3& b, double radius, double edge_radius) {
  const double half = 0.5 * (b - a).norm();
  require(half > 0.0 && edge_radius >= 0.0 && edge_radius <= std::min(radius, half) * (1.0 + 1e-9),
          "cylinder: the radius of the rim does not fit");
  const Vec3 center = 0.5 * (a + b), u = (b - a).normalized();
  const Vec3 reach = half * u.cwiseAbs() + radius * (1.0 - u.array().square()).max(0.0).sqrt().matrix();
  return {[=](const Vec3& p) {
            const double along = (p - center).dot(u);
            const double off = (p - center - along * u).norm();
            const double x = off - radius + edge_radius, y = std::abs(along) - half + edge_radius;
            return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0) -
                   edge_radius;
          },
          box_around(center, reach)};
}

Solid ellipsoid(const Vec3& center, const Vec3& radii) {
  require(radii.minCoeff() > 0.0, "ellipsoid: the half axes must be positive");
  return {[center, radii](const Vec3& p) {
            const Vec3 q = (p - center).cwiseQuotient(radii);
            const double k = q.norm(), slope = q.cwiseQuotient(radii).norm();
            return slope < 1e-9 ? -radii.minCoeff() : k * (k - 1.0) / slope;
          },
          box_around(center, radii)};
}

Solid sweep(std::vector<Section> sections) {
  require(sections.size() >= 2, "sweep: needs at least two sections");
  Box box;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Section& s = sections[i];
    require(s.half_width > 0.0 && s.half_up > 0.0 && s.half_down > 0.0, "sweep: half sizes must be positive");
    require(i == 0 || s.x > sections[i - 1].x, "sweep: stations must increase");
    box.add(Vec3(s.x, s.center_y - s.half_width, s.center_z - s.half_down));
    box.add(Vec3(s.x, s.center_y + s.half_width, s.center_z + s.half_up));
  }
  const SectionCurves curves(sections);
  // Monotone cubics of the centre and of the half sizes can add up to a little more than at the sections.
  const double spare = 0.02 * box.diagonal();
  box.min.array() -= spare;
  box.max.array() += spare;
  return {[curves](const Vec3& p) { return curves.distance(p); }, box};
}

std::vector<Section> round_end(const Section& section, double length, int count) {
  std::vector<Section> result;
  for (int i = 1; i <= count; ++i) {
    const double angle = 0.5 * 3.14159265358979323846 * i / count;
    const double scale = std::max(std::cos(angle), 0.02);
    Section s = section;
    s.x += length * std::sin(angle);
    s.half_width *= scale;
    s.half_up *= scale;
    s.half_down *= scale;
    result.push_back(s);
  }
  if (length < 0.0) std::reverse(result.begin(), result.end());
  return result;
}

}  // namespace eigengrasp::modeling
