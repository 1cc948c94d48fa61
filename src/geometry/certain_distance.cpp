// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <algorithm>
#include <cmath>

#include "eigengrasp/geometry/mesh_motion.hpp"

namespace eigengrasp {

namespace {

double mix(double a, double b, double t) {
  return a + t * (b - a);
}

/// Cell of a grid about a point.
struct Place {
  const float* corner;  ///< its first node
  Eigen::Index step_y;
  Eigen::Index step_z;
  Vec3 weight;
};

bool find_place(const FieldGrid& grid, const Vec3& p, Place& place) {
  const Vec3 u = (p - grid.origin) * (1.0 / grid.cell);
  const Vec3 last = (grid.nodes.array() - 1).cast<double>();
  if (!((u.array() >= 0.0).all() && (u.array() <= last.array()).all())) return false;
  const Eigen::Vector3i i = u.cast<int>().cwiseMin(grid.nodes - Eigen::Vector3i::Constant(2));
  place.step_y = grid.nodes.x();
  place.step_z = place.step_y * grid.nodes.y();
  place.corner = grid.values.data() + i.z() * place.step_z + i.y() * place.step_y + i.x();
  place.weight = u - i.cast<double>();
  return true;
}

double certain_value(const FieldGrid& grid, const Place& at) {
  double v[8];
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 8; ++k) {
    v[k] = std::abs(at.corner[(k & 1) + (k >> 1 & 1) * at.step_y + (k >> 2) * at.step_z]);
    least = std::min(least, v[k]);
  }
  const Vec3& w = at.weight;
  const double value = mix(mix(mix(v[0], v[1], w.x()), mix(v[2], v[3], w.x()), w.y()),
                           mix(mix(v[4], v[5], w.x()), mix(v[6], v[7], w.x()), w.y()), w.z());
  // The distance from the surface's point that is nearest to p is nowhere less than the distance to the
  // surface, is the same at p, and bends along any line by at most 1 / r where it is r.
  constexpr double half_diagonal = 0.8661;  // of a cell
  const double nearest = least - half_diagonal * grid.cell;
  double error = half_diagonal * grid.cell;
  if (nearest > 0.0) error = std::min(error, 0.3751 * grid.cell * grid.cell / nearest);
  return value - error;
}

}  // namespace

double certain_distance(const DistanceField& field, const Vec3& p) {
  const double scale = field.scale();
  const Vec3 q = scale == 1.0 ? p : Vec3(p / scale);
  Place place;
  if (find_place(field.fine(), q, place)) return scale * certain_value(field.fine(), place);
  if (find_place(field.coarse(), q, place)) return scale * certain_value(field.coarse(), place);
  const Box box = field.coarse().box();
  return scale * (box.min - q).cwiseMax(q - box.max).cwiseMax(Vec3::Zero()).norm();
}

}  // namespace eigengrasp
