// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eigengrasp/modeling/primitives.hpp"

namespace eigengrasp::modeling {
namespace {

using Vec2 = Eigen::Vector2d;

Vec2 vec(const Point2& p) {
  return {p[0], p[1]};
}
Point2 point(const Vec2& v) {
  return {v.x(), v.y()};
}

/// Adds the arc that rounds corner b between a and c.
void add_arc(Polyline& out, const Vec2& a, const Vec2& b, const Vec2& c, double radius, double max_angle) {
  const Vec2 u = (a - b).normalized(), v = (c - b).normalized();
  const double half = 0.5 * std::acos(std::clamp(u.dot(v), -1.0, 1.0));  // half of the inner angle
  const double room = 0.499 * std::min((a - b).norm(), (c - b).norm());
  const double cut = std::min(radius / std::tan(half), room);
  const double r = cut * std::tan(half);
  const double turn = std::acos(-1.0) - 2.0 * half;
  if (radius <= 0.0 || r < 1e-9 || turn < 1e-6) {
    out.push_back(point(b));
    return;
  }
  const Vec2 middle = (u + v).normalized();
  const Vec2 center = b + middle * (r / std::sin(half));
  const Vec2 side = (v - u).normalized();
  const int steps = std::max(2, static_cast<int>(std::ceil(turn / max_angle)));
  for (int i = 0; i <= steps; ++i) {
    const double angle = turn * (static_cast<double>(i) / steps - 0.5);
    out.push_back(point(center + r * (std::sin(angle) * side - std::cos(angle) * middle)));
  }
}

Vec2 catmull_rom(const std::array<Vec2, 4>& p, double t) {
  std::array<double, 4> knot{0.0, 0.0, 0.0, 0.0};
  for (std::size_t i = 1; i < 4; ++i)
    knot[i] = knot[i - 1] + std::sqrt(std::max((p[i] - p[i - 1]).norm(), 1e-12));
  const double s = knot[1] + t * (knot[2] - knot[1]);
  std::array<Vec2, 4> q = p;
  for (std::size_t level = 1; level < 4; ++level) {
    for (std::size_t i = 0; i + level < 4; ++i) {
      // The last level blends over the middle span alone.
      const double low = level == 3 ? knot[1] : knot[i], high = level == 3 ? knot[2] : knot[i + level];
      q[i] = ((high - s) * q[i] + (s - low) * q[i + 1]) / (high - low);
    }
  }
  return q[0];
}

/// Closed outline in runs of a few edges with a box each, so that far runs are passed over.
class OutlineIndex {
 public:
  OutlineIndex(const Polyline& outline, bool skip_last) : points_(outline), skip_last_(skip_last) {
    points_.push_back(outline.front());
    for (std::size_t begin = 0; begin < outline.size(); begin += run_length) {
      Run run{begin, std::min(begin + run_length, outline.size()), points_[begin], points_[begin]};
      for (std::size_t i = begin; i <= run.end; ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
          run.low[k] = std::min(run.low[k], points_[i][k]);
          run.high[k] = std::max(run.high[k], points_[i][k]);
        }
      }
      runs_.push_back(run);
    }
  }

  double distance(double x, double y) const {
    double best = 1e300;
    bool inside = false;
    for (const Run& run : runs_) {
      if (y >= run.low[1] && y <= run.high[1]) inside = inside != crosses(run, x, y);
      const double dx = std::max({run.low[0] - x, x - run.high[0], 0.0});
      const double dy = std::max({run.low[1] - y, y - run.high[1], 0.0});
      if (dx * dx + dy * dy < best) best = std::min(best, squared_distance(run, x, y));
    }
    return (inside ? -1.0 : 1.0) * std::sqrt(best);
  }

 private:
  static constexpr std::size_t run_length = 6;
  struct Run {
    std::size_t begin, end;
    Point2 low, high;
  };

  /// Is a ray towards +x cut an odd number of times?
  bool crosses(const Run& run, double x, double y) const {
    bool odd = false;
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const Point2 &a = points_[i], &b = points_[i + 1];
      if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1])) odd = !odd;
    }
    return odd;
  }

  double squared_distance(const Run& run, double x, double y) const {
    double best = 1e300;
    const std::size_t end = skip_last_ && run.end + 1 == points_.size() ? run.end - 1 : run.end;
    for (std::size_t i = run.begin; i < end; ++i) {
      const double ex = points_[i + 1][0] - points_[i][0], ey = points_[i + 1][1] - points_[i][1];
      const double px = x - points_[i][0], py = y - points_[i][1], length2 = ex * ex + ey * ey;
      const double t = length2 > 0.0 ? std::clamp((px * ex + py * ey) / length2, 0.0, 1.0) : 0.0;
      best = std::min(best, (px - t * ex) * (px - t * ex) + (py - t * ey) * (py - t * ey));
    }
    return best;
  }

  Polyline points_;
  bool skip_last_;
  std::vector<Run> runs_;
};

}  // namespace

double outline_distance(const Polyline& outline, double x, double y, bool skip_last) {
  return OutlineIndex(outline, skip_last).distance(x, y);
}

Solid revolve(const Polyline& outline) {
  if (outline.size() < 3) throw std::logic_error("revolve: the outline needs three points");
  Box box;
  for (const Point2& p : outline) {
    box.add(Vec3(p[0], p[0], p[1]));
    box.add(Vec3(-p[0], -p[0], p[1]));
  }
  const bool on_axis = outline.front()[0] < 1e-9 && outline.back()[0] < 1e-9;
  const OutlineIndex index(outline, on_axis);
  return {[index](const Vec3& p) { return index.distance(std::hypot(p.x(), p.y()), p.z()); }, box};
}

Solid extrude(const Polyline& outline, double z_low, double z_high, double edge_radius) {
  if (outline.size() < 3) throw std::logic_error("extrude: the outline needs three points");
  Box box;
  for (const Point2& p : outline) {
    box.add(Vec3(p[0], p[1], z_low));
    box.add(Vec3(p[0], p[1], z_high));
  }
  const OutlineIndex index(outline, false);
  const double middle = 0.5 * (z_low + z_high), half = 0.5 * (z_high - z_low);
  return {[=](const Vec3& p) {
            const double a = index.distance(p.x(), p.y()) + edge_radius;
            const double b = std::abs(p.z() - middle) - half + edge_radius;
            return std::hypot(std::max(a, 0.0), std::max(b, 0.0)) + std::min(std::max(a, b), 0.0) -
                   edge_radius;
          },
          box};
}

Polyline round_corners(const Polyline& outline, const std::vector<double>& radii, bool open,
                       double max_angle) {
  const std::size_t n = outline.size();
  if (radii.size() != n || n < 3) throw std::logic_error("round_corners: one radius a corner is needed");
  Polyline out;
  for (std::size_t i = 0; i < n; ++i) {
    if (open && (i == 0 || i + 1 == n)) {
      out.push_back(outline[i]);
      continue;
    }
    add_arc(out, vec(outline[(i + n - 1) % n]), vec(outline[i]), vec(outline[(i + 1) % n]), radii[i],
            max_angle);
  }
  return out;
}

Polyline smooth_curve(const Polyline& points, int steps, bool closed) {
  const std::size_t n = points.size();
  if (n < 2) throw std::logic_error("smooth_curve: needs two points");
  const auto at = [&](std::ptrdiff_t i) -> Vec2 {
    const auto count = static_cast<std::ptrdiff_t>(n);
    if (closed) return vec(points[static_cast<std::size_t>((i + count) % count)]);
    if (i < 0) return 2.0 * vec(points[0]) - vec(points[1]);
    if (i >= count) return 2.0 * vec(points[n - 1]) - vec(points[n - 2]);
    return vec(points[static_cast<std::size_t>(i)]);
  };
  Polyline out;
  const std::size_t spans = closed ? n : n - 1;
  for (std::size_t i = 0; i < spans; ++i) {
    const auto k = static_cast<std::ptrdiff_t>(i);
    const std::array<Vec2, 4> p{at(k - 1), at(k), at(k + 1), at(k + 2)};
    for (int j = 0; j < steps; ++j) out.push_back(point(catmull_rom(p, static_cast<double>(j) / steps)));
  }
  if (!closed) out.push_back(points.back());
  return out;
}

}  // namespace eigengrasp::modeling
