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
  Vector<B> origin, last;
  Floats<B> cell, inverse_cell;
  Ints<B> row, layer, first;
};

template <class B>
EIGENGRASP_LANES_INLINE LaneGrid<B> splat_grid(const GridView& g) {
  return {splat<B>(g.origin), splat<B>(g.last), Floats<B>(g.cell), Floats<B>(g.inverse_cell),
          Ints<B>(g.row),     Ints<B>(g.layer), Ints<B>(g.first)};
}

template <class B>
EIGENGRASP_LANES_INLINE Mask<B> inside(const GridView& g, const Vector<B>& p) {
  const Vector<B> u = Floats<B>(g.inverse_cell) * (p - splat<B>(g.origin));
  const Vector<B> last = splat<B>(g.last);
  const Floats<B> lowest = min(min(u.x, u.y), u.z);
  const Floats<B> highest = max(max(u.x - last.x, u.y - last.y), u.z - last.z);
  return (Floats<B>(0.0f) <= lowest) & (highest <= Floats<B>(0.0f));
}

template <class B>
EIGENGRASP_LANES_INLINE LaneGrid<B> choose_grid(const FieldView& field, const Vector<B>& p) {
  const Mask<B> fine = inside(field.fine, p);
  const std::uint32_t in_fine = bits(fine);
  if (in_fine == 0xffffu) return splat_grid<B>(field.fine);
  LaneGrid<B> g = splat_grid<B>(field.coarse);
  if (in_fine == 0) return g;
  const LaneGrid<B> f = splat_grid<B>(field.fine);
  const auto pick = [&](const Floats<B>& a, const Floats<B>& b) { return select(fine, a, b); };
  return {{pick(f.origin.x, g.origin.x), pick(f.origin.y, g.origin.y), pick(f.origin.z, g.origin.z)},
          {pick(f.last.x, g.last.x), pick(f.last.y, g.last.y), pick(f.last.z, g.last.z)},
          pick(f.cell, g.cell),
          pick(f.inverse_cell, g.inverse_cell),
          select(fine, f.row, g.row),
          select(fine, f.layer, g.layer),
          select(fine, f.first, g.first)};
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
  const Vector<B> u = g.inverse_cell * (p - g.origin);
  const auto node = [&](const F& v, const F& last) { return truncate(clamp(v + F(0.5f), F(0.0f), last)); };
  const Ints<B> ix = node(u.x, g.last.x);
  const Ints<B> iy = node(u.y, g.last.y);
  const Ints<B> iz = node(u.z, g.last.z);
  const Vector<B> off{u.x - to_float(ix), u.y - to_float(iy), u.z - to_float(iz)};
  const F way = g.cell * sqrt(dot(off, off));
  const F value = gather<B>(field.values, g.first + ix + iy * g.row + iz * g.layer);
  return {value - way, value + way};
}

/// The eight values about a point of a grid.
template <class B>
struct Cell {
  Floats<B> c000, c100, c010, c110, c001, c101, c011, c111;
  Vector<B> f;       ///< place in the cell, 0 to 1
  Vector<B> beyond;  ///< of the point over the grid's border [m]; 0 inside
  Floats<B> inverse_cell;
};

template <class B>
EIGENGRASP_LANES_INLINE Cell<B> look_up(const FieldView& field, const Vector<B>& p) {
  using F = Floats<B>;
  const LaneGrid<B> g = choose_grid<B>(field, p);
  const Vector<B> u = g.inverse_cell * (p - g.origin);
  const Vector<B> q{clamp(u.x, F(0.0f), g.last.x), clamp(u.y, F(0.0f), g.last.y),
                    clamp(u.z, F(0.0f), g.last.z)};
  const auto cell = [&](const F& v, const F& last) { return truncate(min(v, last - F(1.0f))); };
  const Ints<B> ix = cell(q.x, g.last.x);
  const Ints<B> iy = cell(q.y, g.last.y);
  const Ints<B> iz = cell(q.z, g.last.z);
  const Ints<B> at = g.first + ix + iy * g.row + iz * g.layer;
  Cell<B> c;
  gather_pair<B>(field.values, at, c.c000, c.c100);
  gather_pair<B>(field.values, at + g.row, c.c010, c.c110);
  gather_pair<B>(field.values, at + g.layer, c.c001, c.c101);
  gather_pair<B>(field.values, at + g.layer + g.row, c.c011, c.c111);
  c.f = {q.x - to_float(ix), q.y - to_float(iy), q.z - to_float(iz)};
  c.beyond = g.cell * (u - q);
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
  return mix(y0, y1, c.f.z);
}

template <class B>
EIGENGRASP_LANES_INLINE Vector<B> gradient(const Cell<B>& c) {
  const Floats<B> x =
      mix(mix(c.c100 - c.c000, c.c110 - c.c010, c.f.y), mix(c.c101 - c.c001, c.c111 - c.c011, c.f.y), c.f.z);
  const Floats<B> y =
      mix(mix(c.c010 - c.c000, c.c110 - c.c100, c.f.x), mix(c.c011 - c.c001, c.c111 - c.c101, c.f.x), c.f.z);
  const Floats<B> z =
      mix(mix(c.c001 - c.c000, c.c101 - c.c100, c.f.x), mix(c.c011 - c.c010, c.c111 - c.c110, c.f.x), c.f.y);
  return c.inverse_cell * Vector<B>{x, y, z};
}

}  // namespace eigengrasp::kernel
