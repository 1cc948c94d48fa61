// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "planning/kernel/vectors.hpp"

/// Looking distances up for sixteen points at once.
namespace eigengrasp::kernel {

/// Points in a grid: each lane has one of its own, the fine one where that holds the point, else the coarse
/// one.
template <class B>
struct LaneGrid {
  Vector<B> u;     ///< place of the point, in nodes
  Vector<B> last;  ///< as in GridView, as are the rest
  Floats<B> cell, quantum, row, layer, first;
};

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> place_in(const GridView& g, const Vector<B>& p) {
  return Floats<B>(g.inverse_cell) * (p - splat<B>(g.origin));
}

template <class B>
EIGENGRASP_LANES_INLINE LaneGrid<B> grid_at(const GridView& g, const Vector<B>& u) {
  return {u,
          splat<B>(g.last),
          Floats<B>(g.cell),
          Floats<B>(g.quantum),
          Floats<B>(g.row),
          Floats<B>(g.layer),
          Floats<B>(g.first)};
}

/// Lanes whose place lies between the first node and the last ones, before those.
template <class B>
EIGENGRASP_LANES_INLINE Mask<B> inside(const GridView& g, const Vector<B>& u) {
  const Vector<B> over = u - splat<B>(g.last);
  const Floats<B> lowest = min(min(u.x, u.y), u.z);
  const Floats<B> highest = max(max(over.x, over.y), over.z);
  return (Floats<B>(0.0f) <= lowest) & (highest < Floats<B>(0.0f));
}

/// @param fine lanes that the fine grid holds  @param u places in the fine grid
template <class B>
EIGENGRASP_LANES_INLINE LaneGrid<B> choose_grid(const FieldView& field, const Vector<B>& p,
                                                const Mask<B>& fine, const Vector<B>& u) {
  const LaneGrid<B> f = grid_at(field.fine, u);
  const LaneGrid<B> c = grid_at(field.coarse, place_in(field.coarse, p));
  const auto pick = [&](const Floats<B>& a, const Floats<B>& b) { return select(fine, a, b); };
  const auto pick_vector = [&](const Vector<B>& a, const Vector<B>& b) {
    return Vector<B>{pick(a.x, b.x), pick(a.y, b.y), pick(a.z, b.z)};
  };
  return {pick_vector(f.u, c.u),      pick_vector(f.last, c.last), pick(f.cell, c.cell),
          pick(f.quantum, c.quantum), pick(f.row, c.row),          pick(f.layer, c.layer),
          pick(f.first, c.first)};
}

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> clamp_to(const Vector<B>& last, const Vector<B>& u) {
  const Floats<B> zero(0.0f);
  return {clamp(u.x, zero, last.x), clamp(u.y, zero, last.y), clamp(u.z, zero, last.z)};
}

/// Place in the words of a node with whole coordinates.
template <class B>
EIGENGRASP_LANES_INLINE Ints<B> place_of(const LaneGrid<B>& g, const Vector<B>& node) {
  return truncate((g.first + node.x) + (node.y * g.row + node.z * g.layer));
}

/// The distances of a word, in quanta: of its own node, and of the next along z.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> own_distance(const Ints<B>& word) {
  return to_float(shift_left<16>(word));
}
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> next_distance(const Ints<B>& word) {
  return to_float(word & Ints<B>(-65536));
}

/// Bounds of the distance from one node: its value, give or take the way to it.
template <class B>
struct DistanceBounds {
  Floats<B> lower, upper;
};

template <class B>
EIGENGRASP_LANES_INLINE DistanceBounds<B> bound_distance(const FieldView& field, const Vector<B>& p) {
  using F = Floats<B>;
  const Vector<B> fine = place_in(field.fine, p);
  const LaneGrid<B> g = choose_grid<B>(field, p, inside(field.fine, fine), fine);
  const Vector<B> q = clamp_to<B>(g.last, g.u);
  const F whole(12582912.0f);  // 1.5 * 2^23: what is added to it is rounded to a whole number
  const Vector<B> node{(q.x + whole) - whole, (q.y + whole) - whole, (q.z + whole) - whole};
  const Vector<B> off = g.u - node;
  const F way = g.cell * sqrt(dot(off, off));
  const F value = g.quantum * own_distance(gather<B>(field.words, place_of(g, node)));
  return {value - way, value + way};
}

/// The eight distances about a point of a grid, in quanta.
template <class B>
struct Cell {
  Floats<B> c000, c100, c010, c110, c001, c101, c011, c111;
  Vector<B> f;        ///< place in the cell, 0 to 1
  Floats<B> quantum;  ///< [m]
};

/// @param q place in the grid  @param node first one of its cell
template <class B>
EIGENGRASP_LANES_INLINE Cell<B> read_cell(const std::int32_t* words, const LaneGrid<B>& g, const Vector<B>& q,
                                          const Vector<B>& node) {
  const Ints<B> at = place_of(g, node);
  Ints<B> w00, w10, w01, w11;  // along x and y
  gather_pair<B>(words, at, w00, w10);
  gather_pair<B>(words, at + truncate(g.row), w01, w11);
  return {own_distance(w00),  own_distance(w10),  own_distance(w01),  own_distance(w11), next_distance(w00),
          next_distance(w10), next_distance(w01), next_distance(w11), q - node,          g.quantum};
}

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> round_down(const Vector<B>& q) {
  return {to_float(truncate(q.x)), to_float(truncate(q.y)), to_float(truncate(q.z))};
}

template <class B>
EIGENGRASP_LANES_INLINE Cell<B> look_up_inside(const FieldView& field, const Vector<B>& u) {
  return read_cell<B>(field.words, grid_at(field.fine, u), u, round_down(u));
}

/// @param beyond out: of the point over the grid's border [m]; 0 inside
template <class B>
EIGENGRASP_LANES_INLINE Cell<B> look_up_anywhere(const FieldView& field, const LaneGrid<B>& g,
                                                 Vector<B>& beyond) {
  const Floats<B> one(1.0f);
  const Vector<B> q = clamp_to<B>(g.last, g.u);
  beyond = g.cell * (g.u - q);
  const Vector<B> most{g.last.x - one, g.last.y - one, g.last.z - one};
  return read_cell<B>(field.words, g, q,
                      round_down(Vector<B>{min(q.x, most.x), min(q.y, most.y), min(q.z, most.z)}));
}

template <class B>
EIGENGRASP_LANES_INLINE Floats<B> mix(const Floats<B>& a, const Floats<B>& b, const Floats<B>& t) {
  return a + t * (b - a);
}

/// Trilinear [m].
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> distance(const Cell<B>& c) {
  const Floats<B> y0 = mix(mix(c.c000, c.c100, c.f.x), mix(c.c010, c.c110, c.f.x), c.f.y);
  const Floats<B> y1 = mix(mix(c.c001, c.c101, c.f.x), mix(c.c011, c.c111, c.f.x), c.f.y);
  return c.quantum * mix(y0, y1, c.f.z);
}

/// Distance of a point, or of the grid's border where the point is beyond that.
template <class B>
struct PointDistance {
  Floats<B> at_border;  ///< [m]
  Floats<B> beyond;     ///< how far over the border [m]; 0 inside
};

template <class B>
EIGENGRASP_LANES_INLINE PointDistance<B> look_up(const FieldView& field, const Vector<B>& p) {
  const Vector<B> fine = place_in(field.fine, p);
  const Mask<B> in_fine = inside(field.fine, fine);
  if (bits(in_fine) == 0xffffu) return {distance(look_up_inside<B>(field, fine)), Floats<B>(0.0f)};
  Vector<B> beyond;
  const Cell<B> cell = look_up_anywhere<B>(field, choose_grid<B>(field, p, in_fine, fine), beyond);
  return {distance(cell), sqrt(dot(beyond, beyond))};
}

/// Distance with its gradient.
template <class B>
struct PointSlope {
  Floats<B> distance;  ///< [m] of the point, or of the border
  Vector<B> gradient;  ///< in quanta a cell
  Vector<B> beyond;    ///< of the point over the border [m]; 0 inside
};

template <class B>
EIGENGRASP_LANES_INLINE PointSlope<B> look_up_slope(const FieldView& field, const Vector<B>& p) {
  using F = Floats<B>;
  const Vector<B> fine = place_in(field.fine, p);
  PointSlope<B> s;
  const Cell<B> c =
      look_up_anywhere<B>(field, choose_grid<B>(field, p, inside(field.fine, fine), fine), s.beyond);
  const F x00 = c.c100 - c.c000;
  const F x10 = c.c110 - c.c010;
  const F x01 = c.c101 - c.c001;
  const F x11 = c.c111 - c.c011;
  const F d00 = c.c000 + c.f.x * x00;
  const F d01 = c.c001 + c.f.x * x01;
  const F y0 = (c.c010 + c.f.x * x10) - d00;
  const F y1 = (c.c011 + c.f.x * x11) - d01;
  const F d0 = d00 + c.f.y * y0;
  const F z = (d01 + c.f.y * y1) - d0;
  s.gradient = {mix(mix(x00, x10, c.f.y), mix(x01, x11, c.f.y), c.f.z), mix(y0, y1, c.f.z), z};
  s.distance = c.quantum * (d0 + c.f.z * z);
  return s;
}

}  // namespace eigengrasp::kernel
