// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "shape/distance_grid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "eigengrasp/geometry/triangle_queries.hpp"

namespace eigengrasp {

DistanceGrid::DistanceGrid(int side, double reach)
    : side_(side),
      reach_(reach),
      cells_(static_cast<std::size_t>(framed_side()) * static_cast<std::size_t>(framed_side()) *
             static_cast<std::size_t>(framed_side())) {}

void DistanceGrid::offer(Cell& cell, const Vec3& center, int piece) const {
  if (cell.piece == piece) return;
  const Piece& t = pieces_[static_cast<std::size_t>(piece)];
  const Vec3 foot = closest_point_on_triangle({t.a, t.b, t.c}, center);
  const double squared = (foot - center).squaredNorm();
  if (squared < cell.squared) cell = {squared, foot, piece};
}

/// The cell that p lies in and the six beside it.
void DistanceGrid::offer_about(const Vec3& p, int piece) {
  const Eigen::Vector3i at = ((p + Vec3::Ones()) / cell()).array().floor().cast<int>();
  for (int n = 0; n < 7; ++n) {
    Eigen::Vector3i c = at;
    if (n > 0) c[(n - 1) / 2] += n % 2 == 0 ? 1 : -1;
    if ((c.array() < 0).any() || (c.array() >= side_).any()) continue;
    offer(cells_[place(c.x(), c.y(), c.z())], center(c.x(), c.y(), c.z()), piece);
  }
}

/// Offers a triangle to the cells about points of it that are at most a cell apart.
void DistanceGrid::add_piece(const Piece& t) {
  const Vec3 low = t.a.cwiseMin(t.b).cwiseMin(t.c), high = t.a.cwiseMax(t.b).cwiseMax(t.c);
  if ((low.array() > 1.0).any() || (high.array() < -1.0).any()) return;
  const double ab = (t.a - t.b).squaredNorm(), bc = (t.b - t.c).squaredNorm(), ca = (t.c - t.a).squaredNorm();
  if (bc > ab && bc >= ca) return add_piece({t.b, t.c, t.a});  // the longest side first
  if (ca > ab) return add_piece({t.c, t.a, t.b});
  pieces_.push_back(t);
  const int piece = static_cast<int>(pieces_.size()) - 1;
  const Vec3 side = t.b - t.a;
  const double length = std::sqrt(ab);
  const double height = length > 0.0 ? side.cross(t.c - t.a).norm() / length : 0.0;
  const int rows = steps(height);
  for (int i = 0; i < rows; ++i) {
    const double v = (i + 0.5) / rows;
    const int columns = steps((1.0 - v) * length);
    for (int k = 0; k < columns; ++k)
      offer_about(t.a + v * (t.c - t.a) + (1.0 - v) * ((k + 0.5) / columns) * side, piece);
  }
}

/// Into how many pieces, of a cell at most, a length is cut. Shapes far larger than the ball are not looked
/// at that closely.
int DistanceGrid::steps(double length) const {
  return std::max(1, static_cast<int>(std::ceil(std::min(length / cell(), 50.0 * side_))));
}

/// One pass over the grid: every cell tries the 13 neighbours that come before it. A neighbour's piece is
/// looked at only where its foot would be nearer already.
void DistanceGrid::spread(int direction) {
  std::array<std::ptrdiff_t, 13> earlier;  // of 27 neighbours in order, those before the middle
  for (int n = 0; n < 13; ++n)
    earlier[static_cast<std::size_t>(n)] =
        direction * (((n / 9 - 1) * framed_side() + n / 3 % 3 - 1) * framed_side() + n % 3 - 1);
  const double reach2 = reach_ * reach_;
  const auto at = [&](int k) { return direction > 0 ? k : side_ - 1 - k; };
  for (int k = 0; k < side_; ++k)
    for (int j = 0; j < side_; ++j)
      for (int i = 0; i < side_; ++i) {
        const Vec3 p = center(at(i), at(j), at(k));
        Cell* const cell = &cells_[place(at(i), at(j), at(k))];
        for (const std::ptrdiff_t offset : earlier) {
          const Cell& other = cell[offset];
          if (other.squared > reach2 || other.piece == cell->piece) continue;
          if ((other.foot - p).squaredNorm() < cell->squared) offer(*cell, p, other.piece);
        }
      }
}

void DistanceGrid::add_surface(const TriangleMesh& mesh, const ShapeBall& ball) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    add_piece({(mesh.corner(t, 0) - ball.center) / ball.radius,
               (mesh.corner(t, 1) - ball.center) / ball.radius,
               (mesh.corner(t, 2) - ball.center) / ball.radius});
  for (const int direction : {1, -1}) spread(direction);
}

}  // namespace eigengrasp
