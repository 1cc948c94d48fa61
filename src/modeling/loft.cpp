// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/modeling/loft.hpp"

#include <algorithm>
#include <cmath>

namespace eigengrasp::modeling {
namespace {

/// y_lo, z_lo, y_hi, z_hi, y_center, z_center, power, roll
using SectionValues = std::array<double, 8>;

SectionValues values_of(const LoftSection& s) {
  return {s.lo.x(), s.lo.y(), s.hi.x(), s.hi.y(), s.center.x(), s.center.y(), s.power, s.roll};
}

/// Slope at the middle of three points that neither overshoots nor rings (harmonic mean, after Fritsch and
/// Butland).
double monotone_slope(double h0, double d0, double h1, double d1) {
  if (d0 * d1 <= 0) return 0.0;
  const double w0 = 2 * h1 + h0;
  const double w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

class Loft {
 public:
  Loft(const std::vector<LoftSection>& sections, const std::array<double, 2>& caps) : caps_(caps) {
    for (const LoftSection& s : sections) {
      at_.push_back(s.at);
      values_.push_back(values_of(s));
    }
    slopes_.assign(at_.size(), SectionValues{});
    for (std::size_t i = 0; i < at_.size(); ++i) {
      for (std::size_t k = 0; k < 8; ++k) slopes_[i][k] = slope_at(i, k);
    }
  }

  /// Zero on the surface, -1 on the spine; not a distance yet.
  double level(const Vec3& p) const {
    const double first = at_.front() + caps_[0];
    const double last = at_.back() - caps_[1];
    const SectionValues s = section(std::clamp(p.x(), at_.front(), at_.back()));
    const double c = std::cos(s[7]);
    const double r = std::sin(s[7]);
    const double y = c * (p.y() - s[4]) + r * (p.z() - s[5]);
    const double z = c * (p.z() - s[5]) - r * (p.y() - s[4]);
    const double n = s[6];
    const double u = std::abs(y) / (y < 0 ? s[4] - s[0] : s[2] - s[4]);
    const double v = std::abs(z) / (z < 0 ? s[5] - s[1] : s[3] - s[5]);
    const double rho = std::pow(std::pow(u, n) + std::pow(v, n), 1.0 / n);
    const double t = std::max({0.0, (first - p.x()) / caps_[0], (p.x() - last) / caps_[1]});
    return std::hypot(rho, t) - 1.0;
  }

  double distance(const Vec3& p) const {
    constexpr double step = 1e-5;
    const double g = level(p);
    Vec3 slope;
    for (int i = 0; i < 3; ++i) slope[i] = (level(p + step * Vec3::Unit(i)) - g) / step;
    // Inside, far from a short cap, the level knows nothing of the end.
    return std::max({g / std::max(slope.norm(), 1.0), at_.front() - p.x(), p.x() - at_.back()});
  }

 private:
  double secant(std::size_t i, std::size_t k) const {
    return (values_[i + 1][k] - values_[i][k]) / (at_[i + 1] - at_[i]);
  }

  double slope_at(std::size_t i, std::size_t k) const {
    if (i == 0) return secant(0, k);
    if (i + 1 == at_.size()) return secant(i - 1, k);
    return monotone_slope(at_[i] - at_[i - 1], secant(i - 1, k), at_[i + 1] - at_[i], secant(i, k));
  }

  SectionValues section(double x) const {
    const auto next = std::upper_bound(at_.begin() + 1, at_.end() - 1, x);
    const auto i = static_cast<std::size_t>(next - at_.begin()) - 1;
    const double h = at_[i + 1] - at_[i];
    const double t = (x - at_[i]) / h;
    const double a = (1 + 2 * t) * (1 - t) * (1 - t);
    const double b = t * (1 - t) * (1 - t) * h;
    const double c = t * t * (3 - 2 * t);
    const double d = t * t * (t - 1) * h;
    SectionValues s;
    for (std::size_t k = 0; k < 8; ++k) {
      s[k] = a * values_[i][k] + b * slopes_[i][k] + c * values_[i + 1][k] + d * slopes_[i + 1][k];
    }
    return s;
  }

  std::vector<double> at_;
  std::vector<SectionValues> values_;
  std::vector<SectionValues> slopes_;
  std::array<double, 2> caps_;
};

}  // namespace

Solid loft(const std::vector<LoftSection>& sections, const std::array<double, 2>& caps) {
  Box box;
  for (const LoftSection& s : sections) {
    // A rolled section stays within the circle through its farthest corner.
    const double reach = (s.hi - s.center).cwiseMax(s.center - s.lo).norm();
    const Eigen::Vector2d lo = s.roll == 0 ? s.lo : Eigen::Vector2d(s.center.array() - reach);
    const Eigen::Vector2d hi = s.roll == 0 ? s.hi : Eigen::Vector2d(s.center.array() + reach);
    box.add(Vec3(s.at, lo.x(), lo.y()));
    box.add(Vec3(s.at, hi.x(), hi.y()));
  }
  return {[body = Loft(sections, caps)](const Vec3& p) { return body.distance(p); }, box};
}

}  // namespace eigengrasp::modeling
