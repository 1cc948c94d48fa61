// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "modeling/operations.hpp"

#include <algorithm>
#include <stdexcept>

namespace eigengrasp::modeling {
namespace {

double blended_min(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - 0.25 * h * h * blend;
}

Box grown(Box box, double by) {
  box.min.array() -= by;
  box.max.array() += by;
  return box;
}

Box common(const Box& a, const Box& b) {
  Box box;
  box.min = a.min.cwiseMax(b.min);
  box.max = a.max.cwiseMin(b.max);
  return box;
}

Box joined(Box a, const Box& b) {
  a.add(b);
  return a;
}

}  // namespace

Vec3 gradient(const Solid& solid, const Vec3& p, double h) {
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    Vec3 q = p;
    q[k] = p[k] + h;
    const double high = solid(q);
    q[k] = p[k] - h;
    g[k] = (high - solid(q)) / (2.0 * h);
  }
  return g;
}

Solid unite(const Solid& a, const Solid& b) {
  return {[a, b](const Vec3& p) { return std::min(a(p), b(p)); }, joined(a.box, b.box)};
}

Solid unite(const std::vector<Solid>& solids) {
  if (solids.empty()) throw std::logic_error("unite: no solid given");
  Box box;
  for (const Solid& s : solids) box.add(s.box);
  return {[solids](const Vec3& p) {
            double d = solids.front()(p);
            for (std::size_t i = 1; i < solids.size(); ++i) d = std::min(d, solids[i](p));
            return d;
          },
          box};
}

Solid smooth_unite(const Solid& a, const Solid& b, double blend) {
  return {[a, b, blend](const Vec3& p) { return blended_min(a(p), b(p), blend); },
          grown(joined(a.box, b.box), 0.25 * blend)};
}

Solid subtract(const Solid& a, const Solid& b) {
  return {[a, b](const Vec3& p) { return std::max(a(p), -b(p)); }, a.box};
}

Solid smooth_subtract(const Solid& a, const Solid& b, double blend) {
  return {[a, b, blend](const Vec3& p) { return -blended_min(-a(p), b(p), blend); }, a.box};
}

Solid intersect(const Solid& a, const Solid& b) {
  return {[a, b](const Vec3& p) { return std::max(a(p), b(p)); }, common(a.box, b.box)};
}

Solid smooth_intersect(const Solid& a, const Solid& b, double blend) {
  return {[a, b, blend](const Vec3& p) { return -blended_min(-a(p), -b(p), blend); }, common(a.box, b.box)};
}

Solid move(const Solid& solid, const Pose& X_PS) {
  Box box;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p = solid.box.min;
    for (int k = 0; k < 3; ++k) {
      if (corner & (1 << k)) p[k] = solid.box.max[k];
    }
    box.add(Vec3(X_PS * p));
  }
  const Pose X_SP = X_PS.inverse();
  return {[solid, X_SP](const Vec3& p) { return solid(X_SP * p); }, box};
}

Solid move(const Solid& solid, const Vec3& offset) {
  Box box = solid.box;
  box.min += offset;
  box.max += offset;
  return {[solid, offset](const Vec3& p) { return solid(p - offset); }, box};
}

Solid mirror(const Solid& solid, int axis) {
  Box box = solid.box;
  box.min[axis] = -solid.box.max[axis];
  box.max[axis] = -solid.box.min[axis];
  return {[solid, axis](const Vec3& p) {
            Vec3 q = p;
            q[axis] = -q[axis];
            return solid(q);
          },
          box};
}

Solid inflate(const Solid& solid, double distance) {
  return {[solid, distance](const Vec3& p) { return solid(p) - distance; }, grown(solid.box, distance)};
}

Solid half_space(const Vec3& point, const Vec3& outward_normal, const Box& box) {
  const Vec3 n = outward_normal.normalized();
  return {[point, n](const Vec3& p) { return (p - point).dot(n); }, box};
}

}  // namespace eigengrasp::modeling
