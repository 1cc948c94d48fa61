// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "quality/wrench_support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eigengrasp::detail {

void PointSupport::store(std::span<const Vec6> wrenches) {
  n_ = wrenches.size();
  stride_ = (n_ + 3) / 4 * 4;
  coordinates_.assign(6 * stride_, 0.0);
  dots_.resize(stride_);
  scale_ = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t k = 0; k < 6; ++k) coordinates_[k * stride_ + i] = wrenches[i][static_cast<int>(k)];
    scale_ = std::max(scale_, wrenches[i].norm());
  }
}

void PointSupport::assign(std::span<const Vec6> wrenches) {
  ends_.clear();
  store(wrenches);
}

void PointSupport::assign_sum(std::span<const Vec6> wrenches, std::span<const std::size_t> ends) {
  ends_.assign(ends.begin(), ends.end());
  store(wrenches);
  scale_ *= static_cast<double>(ends.size());
}

void PointSupport::compute_dots(const Vec6& u) const {
  const double* c = coordinates_.data();
  double* out = dots_.data();
  const std::size_t s = stride_;
  for (std::size_t i = 0; i < s; ++i) {
    out[i] = (c[i] * u[0] + c[s + i] * u[1]) + (c[2 * s + i] * u[2] + c[3 * s + i] * u[3]) +
             (c[4 * s + i] * u[4] + c[5 * s + i] * u[5]);
  }
}

Vec6 PointSupport::wrench(std::size_t i) const {
  Vec6 w;
  for (std::size_t k = 0; k < 6; ++k) w[static_cast<int>(k)] = coordinates_[k * stride_ + i];
  return w;
}

double PointSupport::support(const Vec6& u, Vec6& w) const {
  if (n_ == 0) return std::numeric_limits<double>::lowest();
  compute_dots(u);
  const auto dots = dots_.begin();
  const auto at = [&](std::size_t i) { return dots + static_cast<std::ptrdiff_t>(i); };
  if (ends_.empty()) {
    const auto best = std::max_element(dots, at(n_));
    w = wrench(static_cast<std::size_t>(best - dots));
    return *best;
  }
  double sum = 0.0;
  w.setZero();
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    const auto best = std::max_element(at(begin), at(end));
    if (begin<end&& * best> 0.0) {
      sum += *best;
      w += wrench(static_cast<std::size_t>(best - dots));
    }
    begin = end;
  }
  return sum;
}

void ConeSupport::assign(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options) {
  cones_.clear();
  norm_ = options.norm;
  scale_ = 0.0;
  for (const ContactPoint& c : contacts) {
    const Vec3 lever = (c.p_OC - options.torque_origin_O) / options.torque_scale;
    cones_.push_back({c.n_OC, lever, c.mu, c.torsion_length / options.torque_scale});
    const double force = std::hypot(1.0, c.mu);
    const double largest = std::hypot(force, force * lever.norm() + c.mu * cones_.back().spin);
    scale_ = norm_ == WrenchNorm::linf ? scale_ + largest : std::max(scale_, largest);
  }
}

// u . w = f . (u_f + u_tau x lever) + mu spin s (u_tau . n) for force f and share s of the friction torque:
// linear in (f, s), so the best of the ellipsoid is closed form.
double ConeSupport::Cone::support(const Vec6& u) const {
  const Vec3 u_tau = u.tail<3>();
  const Vec3 a = u.head<3>() + u_tau.cross(lever);
  const double along = a.dot(n);
  const double torsion = spin * u_tau.dot(n);
  return along + mu * std::sqrt((a - along * n).squaredNorm() + torsion * torsion);
}

void ConeSupport::Cone::add_point(const Vec6& u, Vec6& w) const {
  const Vec3 u_tau = u.tail<3>();
  const Vec3 a = u.head<3>() + u_tau.cross(lever);
  Vec3 tangential = a - a.dot(n) * n;
  tangential -= tangential.dot(n) * n;  // again: it may be short, and is made long
  const double torsion = spin * u_tau.dot(n);
  const double length = std::sqrt(tangential.squaredNorm() + torsion * torsion);
  const double factor = length > 0.0 ? mu / length : 0.0;
  const Vec3 force = n + factor * tangential;
  w.head<3>() += force;
  w.tail<3>() += lever.cross(force) + (factor * torsion * spin) * n;
}

double ConeSupport::support(const Vec6& u, Vec6& w) const {
  w.setZero();
  if (norm_ == WrenchNorm::linf) {
    double sum = 0.0;
    for (const Cone& cone : cones_) {
      const double value = cone.support(u);
      if (value <= 0.0) continue;
      sum += value;
      cone.add_point(u, w);
    }
    return sum;
  }
  double best = std::numeric_limits<double>::lowest();
  const Cone* where = nullptr;
  for (const Cone& cone : cones_) {
    const double value = cone.support(u);
    if (value > best) {
      best = value;
      where = &cone;
    }
  }
  if (where != nullptr) where->add_point(u, w);
  return best;
}

}  // namespace eigengrasp::detail
