// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "solid.hpp"

#include <array>
#include <utility>

namespace eigengrasp::shapes {
namespace {

using Vec2 = Eigen::Vector2d;

Box box_of(const Vec3& min, const Vec3& max) {
  Box box;
  box.add(min);
  box.add(max);
  return box;
}

/// Distance of a profile with distance d_profile that stands from -half to half along its third axis.
double extruded(double d_profile, double along, double half) {
  const double w = std::abs(along) - half;
  const double outside = std::hypot(std::max(d_profile, 0.0), std::max(w, 0.0));
  return std::min(std::max(d_profile, w), 0.0) + outside;
}

double polygon_distance(const std::vector<Vec2>& outline, const Vec2& p) {
  double nearest = (p - outline.front()).squaredNorm();
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2& a = outline[i];
    const Vec2 edge = outline[j] - a;
    const Vec2 w = p - a;
    const double t = std::clamp(w.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (w - t * edge).squaredNorm());
    if ((a.y() > p.y()) != (outline[j].y() > p.y()) && w.x() < edge.x() * w.y() / edge.y()) inside = !inside;
  }
  return (inside ? -1.0 : 1.0) * std::sqrt(nearest);
}

double smooth_min(double a, double b, double blend) {
  if (blend <= 0) return std::min(a, b);
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - 0.25 * h * h * blend;
}

}  // namespace

Solid make_box(const Vec3& size, double round) {
  const Vec3 half = 0.5 * size;
  const Vec3 core = half.array() - round;
  auto distance = [core, round](const Vec3& p) {
    const Vec3 q = p.cwiseAbs() - core;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - round;
  };
  return {distance, box_of(-half, half)};
}

Solid make_cylinder(double radius, double height, double round) {
  auto distance = [radius, height, round](const Vec3& p) {
    return extruded(std::hypot(p.x(), p.y()) - (radius - round), p.z(), 0.5 * height - round) - round;
  };
  const Vec3 half(radius, radius, 0.5 * height);
  return {distance, box_of(-half, half)};
}

Solid make_round_cone(const Vec3& p1, double r1, const Vec3& p2, double r2) {
  const Vec3 axis = p2 - p1;
  const double length = axis.norm();
  const Vec3 u = axis / length;
  const double b = std::clamp((r1 - r2) / length, -1.0, 1.0);
  const double a = std::sqrt(1.0 - b * b);
  auto distance = [=](const Vec3& p) {
    const double y = (p - p1).dot(u);
    const double x = (p - p1 - y * u).norm();
    const double k = -b * x + a * y;
    if (k < 0) return std::hypot(x, y) - r1;
    if (k > a * length) return std::hypot(x, y - length) - r2;
    return a * x + b * y - r1;
  };
  Box box = box_of(p1 - Vec3::Constant(r1), p1 + Vec3::Constant(r1));
  box.add(box_of(p2 - Vec3::Constant(r2), p2 + Vec3::Constant(r2)));
  return {distance, box};
}

Solid make_ellipsoid(const Vec3& radii) {
  auto distance = [radii](const Vec3& p) {
    const double k = p.cwiseQuotient(radii).norm();
    const double slope = p.cwiseQuotient(radii.cwiseAbs2()).norm();
    return slope > 0 ? k * (k - 1.0) / slope : -radii.minCoeff();
  };
  return {distance, box_of(-radii, radii)};
}

Solid make_plate(const std::vector<Vec2>& outline, double height, double round) {
  auto distance = [outline, height, round](const Vec3& p) {
    const double d = polygon_distance(outline, p.head<2>());
    return extruded(d + round, p.z(), 0.5 * height - round) - round;
  };
  Box box;
  for (const Vec2& p : outline) {
    box.add(Vec3(p.x(), p.y(), -0.5 * height));
    box.add(Vec3(p.x(), p.y(), 0.5 * height));
  }
  return {distance, box};
}

Solid moved(Solid a, const Pose& X) {
  Box box;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1 ? a.bounds.max : a.bounds.min).x(), (i & 2 ? a.bounds.max : a.bounds.min).y(),
                      (i & 4 ? a.bounds.max : a.bounds.min).z());
    box.add(X * corner);
  }
  const Pose X_inverse = X.inverse();
  return {[f = std::move(a.distance), X_inverse](const Vec3& p) { return f(X_inverse * p); }, box};
}

Solid united(Solid a, Solid b, double blend) {
  Box box = a.bounds;
  box.add(b.bounds);
  return {[f = std::move(a.distance), g = std::move(b.distance), blend](const Vec3& p) {
            return smooth_min(f(p), g(p), blend);
          },
          box};
}

Solid subtracted(Solid a, Solid b, double blend) {
  return {[f = std::move(a.distance), g = std::move(b.distance), blend](const Vec3& p) {
            return -smooth_min(-f(p), g(p), blend);
          },
          a.bounds};
}

Solid intersected(Solid a, Solid b, double blend) {
  const Box box = box_of(a.bounds.min.cwiseMax(b.bounds.min), a.bounds.max.cwiseMin(b.bounds.max));
  return {[f = std::move(a.distance), g = std::move(b.distance), blend](const Vec3& p) {
            return -smooth_min(-f(p), -g(p), blend);
          },
          box};
}

Vec3 outward_normal(const Solid& solid, const Vec3& p) {
  constexpr double step = 1e-5;
  Vec3 g;
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = step * Vec3::Unit(i);
    g[i] = (solid.distance(p + e) - solid.distance(p - e)) / (2 * step);
  }
  const double length = g.norm();
  return length > 0 ? Vec3(g / length) : Vec3(Vec3::UnitZ());
}

Vec3 project_to_surface(const Solid& solid, Vec3 p) {
  for (int i = 0; i < 8; ++i) {
    const double d = solid.distance(p);
    if (std::abs(d) < 1e-7) break;
    p -= std::clamp(d, -1e-3, 1e-3) * outward_normal(solid, p);
  }
  return p;
}

}  // namespace eigengrasp::shapes
