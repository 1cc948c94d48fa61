// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/modeling/operations.hpp"

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

/// Distance [m] to the box, 0 inside: no point of the solid in it is nearer. Solids whose box is far are not
/// asked.
double box_distance(const Box& box, const Vec3& p) {
  return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).norm();
}

/// From here on the box alone stands for an intersection.
double far_from(const Box& box, double blend) {
  return blend + 0.05 * box.diagonal();
}

}  // namespace

Vec3 gradient(const Solid& solid, const Vec3& p, double h) {
  // Four corners of a tetrahedron: exact for linear functions, two evaluations fewer than central
  // differences.
  static const Vec3 corners[] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
  Vec3 g = Vec3::Zero();
  for (const Vec3& c : corners) g += c * solid(p + h * c);
  g /= 4.0 * h;
  return g;
}

Solid unite(const Solid& a, const Solid& b) {
  return unite(std::vector<Solid>{a, b});
}

Solid unite(const std::vector<Solid>& solids) {
  if (solids.empty()) throw std::logic_error("unite: no solid given");
  Box box;
  for (const Solid& s : solids) box.add(s.box);
  return {[solids](const Vec3& p) {
            double d = solids.front()(p);
            for (std::size_t i = 1; i < solids.size(); ++i) {
              if (box_distance(solids[i].box, p) < d) d = std::min(d, solids[i](p));
            }
            return d;
          },
          box};
}

Solid smooth_unite(const Solid& a, const Solid& b, double blend) {
  return {[a, b, blend](const Vec3& p) {
            const double d = a(p);
            return box_distance(b.box, p) > d + blend ? d : blended_min(d, b(p), blend);
          },
          grown(joined(a.box, b.box), 0.25 * blend)};
}

Solid subtract(const Solid& a, const Solid& b) {
  return {[a, b](const Vec3& p) {
            const double d = a(p);
            return box_distance(b.box, p) > std::max(0.0, -d) ? d : std::max(d, -b(p));
          },
          a.box};
}

Solid smooth_subtract(const Solid& a, const Solid& b, double blend) {
  return {[a, b, blend](const Vec3& p) {
            const double d = a(p);
            return box_distance(b.box, p) > std::max(0.0, blend - d) ? d : -blended_min(-d, b(p), blend);
          },
          a.box};
}

Solid intersect(const Solid& a, const Solid& b) {
  const Box box = common(a.box, b.box);
  return {[a, b, box](const Vec3& p) {
            const double away = box_distance(box, p);
            return away > far_from(box, 0.0) ? away : std::max(a(p), b(p));
          },
          box};
}

Solid smooth_intersect(const Solid& a, const Solid& b, double blend) {
  const Box box = common(a.box, b.box);
  return {[a, b, blend, box](const Vec3& p) {
            const double away = box_distance(box, p);
            return away > far_from(box, blend) ? away : -blended_min(-a(p), -b(p), blend);
          },
          box};
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
