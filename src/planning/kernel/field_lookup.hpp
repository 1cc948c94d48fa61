// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "planning/kernel/vectors.hpp"

/// Looking distances up for sixteen points at once.
namespace eigengrasp::kernel {

/// A GridView with lanes of its own: points look into the fine grid where that holds them, else into the
/// coarse one.
template <class B>
struct LaneGrid {
  Vector<B> u;     ///< place of the point, in nodes
  Vector<B> last;  ///< as in GridView, as are the rest
  Floats<B> cell, inverse_cell, quantum;
  Ints<B> row, layer, first;
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
          Floats<B>(g.inverse_cell),
          Floats<B>(g.quantum),
          Ints<B>(g.row),
          Ints<B>(g.layer),
          Ints<B>(g.first)};
}

/// Lanes whose place lies between the first and the last nodes.
template <class B>
EIGENGRASP_LANES_INLINE Mask<B> inside(const GridView& g, const Vector<B>& u) {
  const Vector<B> last = splat<B>(g.last);
  const Floats<B> lowest = min(min(u.x, u.y), u.z);
  const Floats<B> highest = max(max(u.x - last.x, u.y - last.y), u.z - last.z);
  return (Floats<B>(0.0f) <= lowest) & (highest <= Floats<B>(0.0f));
}

template <class B>
EIGENGRASP_LANES_INLINE LaneGrid<B> choose_grid(const FieldView& field, const Vector<B>& p) {
  const LaneGrid<B> f = grid_at(field.fine, place_in(field.fine, p));
  const Mask<B> fine = inside(field.fine, f.u);
  if (bits(fine) == 0xffffu) return f;
  const LaneGrid<B> c = grid_at(field.coarse, place_in(field.coarse, p));
  const auto pick = [&](const auto& a, const auto& b) { return select(fine, a, b); };
  const auto pick_vector = [&](const Vector<B>& a, const Vector<B>& b) {
    return Vector<B>{pick(a.x, b.x), pick(a.y, b.y), pick(a.z, b.z)};
  };
  return {pick_vector(f.u, c.u),
          pick_vector(f.last, c.last),
          pick(f.cell, c.cell),
          pick(f.inverse_cell, c.inverse_cell),
          pick(f.quantum, c.quantum),
          pick(f.row, c.row),
          pick(f.layer, c.layer),
          pick(f.first, c.first)};
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
  const LaneGrid<B> g = choose_grid<B>(field, p);
  const Vector<B>& u = g.u;
  const auto node = [&](const F& v, const F& last) { return truncate(clamp(v + F(0.5f), F(0.0f), last)); };
  const Ints<B> ix = node(u.x, g.last.x);
  const Ints<B> iy = node(u.y, g.last.y);
  const Ints<B> iz = node(u.z, g.last.z);
  const Vector<B> off{u.x - to_float(ix), u.y - to_float(iy), u.z - to_float(iz)};
  const F way = g.cell * sqrt(dot(off, off));
  const Ints<B> at = g.first + ix + iy * g.row + iz * g.layer;
  const F value = g.quantum * own_distance(gather<B>(field.words, at));
  return {value - way, value + way};
}

/// The eight distances about a point of a grid, in quanta.
template <class B>
struct Cell {
  Floats<B> c000, c100, c010, c110, c001, c101, c011, c111;
  Vector<B> f;       ///< place in the cell, 0 to 1
  Vector<B> beyond;  ///< of the point over the grid's border [m]; 0 inside
  Floats<B> quantum;       ///< [m]
  Floats<B> inverse_cell;  ///< [1/m]
};

template <class B>
EIGENGRASP_LANES_INLINE Cell<B> look_up(const FieldView& field, const Vector<B>& p) {
  using F = Floats<B>;
  const LaneGrid<B> g = choose_grid<B>(field, p);
  const Vector<B>& u = g.u;
  const Vector<B> q{clamp(u.x, F(0.0f), g.last.x), clamp(u.y, F(0.0f), g.last.y),
                    clamp(u.z, F(0.0f), g.last.z)};
  const auto cell = [&](const F& v, const F& last) { return truncate(min(v, last - F(1.0f))); };
  const Ints<B> ix = cell(q.x, g.last.x);
  const Ints<B> iy = cell(q.y, g.last.y);
  const Ints<B> iz = cell(q.z, g.last.z);
  const Ints<B> at = g.first + ix + iy * g.row + iz * g.layer;
  Cell<B> c;
  Ints<B> w00, w10, w01, w11;  // along x and y
  gather_pair<B>(field.words, at, w00, w10);
  gather_pair<B>(field.words, at + g.row, w01, w11);
  c.c000 = own_distance(w00);
  c.c100 = own_distance(w10);
  c.c010 = own_distance(w01);
  c.c110 = own_distance(w11);
  c.c001 = next_distance(w00);
  c.c101 = next_distance(w10);
  c.c011 = next_distance(w01);
  c.c111 = next_distance(w11);
  c.f = {q.x - to_float(ix), q.y - to_float(iy), q.z - to_float(iz)};
  c.beyond = g.cell * (u - q);
  c.quantum = g.quantum;
  c.inverse_cell = g.inverse_cell;
  return c;
}

template <class B>
EIGENGRASP_LANES_INLINE Floats<B> mix(const Floats<B>& a, const Floats<B>& b, const Floats<B>& t) {
  return a + t * (b - a);
}

/// Trilinear distance; beyond the grid that at the border.
template <class B>
EIGENGRASP_LANES_INLINE Floats<B> distance(const Cell<B>& c) {
  const Floats<B> y0 = mix(mix(c.c000, c.c100, c.f.x), mix(c.c010, c.c110, c.f.x), c.f.y);
  const Floats<B> y1 = mix(mix(c.c001, c.c101, c.f.x), mix(c.c011, c.c111, c.f.x), c.f.y);
  return c.quantum * mix(y0, y1, c.f.z);
}

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> gradient(const Cell<B>& c) {
  const Floats<B> x =
      mix(mix(c.c100 - c.c000, c.c110 - c.c010, c.f.y), mix(c.c101 - c.c001, c.c111 - c.c011, c.f.y), c.f.z);
  const Floats<B> y =
      mix(mix(c.c010 - c.c000, c.c110 - c.c100, c.f.x), mix(c.c011 - c.c001, c.c111 - c.c101, c.f.x), c.f.z);
  const Floats<B> z =
      mix(mix(c.c001 - c.c000, c.c101 - c.c100, c.f.x), mix(c.c011 - c.c010, c.c111 - c.c110, c.f.x), c.f.y);
  return (c.quantum * c.inverse_cell) * Vector<B>{x, y, z};
}

}  // namespace eigengrasp::kernel
