// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/modeling/polygonise.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "eigengrasp/core/parallel.hpp"
#include "eigengrasp/modeling/mesh_tools.hpp"

namespace eigengrasp::modeling {
namespace {

/// Distances at the nodes of a regular grid.
struct Grid {
  Vec3 origin;
  double cell = 0.0;
  std::array<std::size_t, 3> count{};
  std::vector<double> value;

  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return i + count[0] * (j + count[1] * k);
  }
  /// Node reached from node n by +1 along x, y, z where bits 0, 1, 2 of mask are set.
  std::size_t step(std::size_t n, unsigned mask) const {
    return n + (mask & 1u ? 1 : 0) + (mask & 2u ? count[0] : 0) + (mask & 4u ? count[0] * count[1] : 0);
  }
  Vec3 node(std::size_t n) const {
    const std::size_t i = n % count[0], j = n / count[0] % count[1], k = n / (count[0] * count[1]);
    return origin + cell * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  }
  bool on_border(std::size_t i, std::size_t j, std::size_t k) const {
    return i == 0 || j == 0 || k == 0 || i + 1 == count[0] || j + 1 == count[1] || k + 1 == count[2];
  }
};

Grid make_grid(const Solid& solid, double cell) {
  Grid grid;
  grid.cell = cell;
  for (int axis = 0; axis < 3; ++axis) {
    const auto steps = std::ceil(solid.box.size()[axis] / cell) + 4.0;
    grid.count[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(steps) + 1;
    // Off the round numbers, where designs like to put planes.
    grid.origin[axis] = solid.box.center()[axis] - 0.5 * steps * cell + 0.013 * cell * (axis + 1);
  }
  grid.value.resize(grid.count[0] * grid.count[1] * grid.count[2]);
  return grid;
}

/// Nodes [begin, begin + 4) along each axis; where the middle is far from the surface its value stands for
/// all.
void sample_block(const Solid& solid, Grid& grid, const std::array<std::size_t, 3>& begin) {
  constexpr std::size_t width = 4;
  std::array<std::size_t, 3> end{};
  for (std::size_t a = 0; a < 3; ++a) end[a] = std::min(begin[a] + width, grid.count[a]);
  const Vec3 middle = grid.node(grid.index(begin[0], begin[1], begin[2])) + Vec3::Constant(1.5 * grid.cell);
  const double there = solid(middle);
  // The corners are 2.6 cells away; twice that, as distances may be of first order only.
  const bool far = std::abs(there) > 5.5 * grid.cell;
  for (std::size_t k = begin[2]; k < end[2]; ++k) {
    for (std::size_t j = begin[1]; j < end[1]; ++j) {
      for (std::size_t i = begin[0]; i < end[0]; ++i) {
        const std::size_t n = grid.index(i, j, k);
        grid.value[n] = far ? there : solid(grid.node(n));
        if (grid.value[n] < 0.0 && grid.on_border(i, j, k)) {
          throw std::logic_error("polygonise: the surface leaves the box of the solid");
        }
      }
    }
  }
}

Grid sample(const Solid& solid, double cell, int n_threads) {
  Grid grid = make_grid(solid, cell);
  parallel_for((grid.count[2] + 3) / 4, n_threads, [&](std::size_t slab, int) {
    for (std::size_t j = 0; j < grid.count[1]; j += 4) {
      for (std::size_t i = 0; i < grid.count[0]; i += 4) sample_block(solid, grid, {i, j, 4 * slab});
    }
  });
  return grid;
}

/// Marching tetrahedra: each cube in six tetrahedra around its diagonal (Freudenthal), which fit face to
/// face, so that the surface is always closed and manifold.
class Marcher {
 public:
  Marcher(const Solid& solid, const Grid& grid) : solid_(solid), grid_(grid) {}

  TriangleMesh run() {
    for (std::size_t k = 0; k + 1 < grid_.count[2]; ++k) {
      for (std::size_t j = 0; j + 1 < grid_.count[1]; ++j) {
        for (std::size_t i = 0; i + 1 < grid_.count[0]; ++i) cube(grid_.index(i, j, k));
      }
    }
    return std::move(mesh_);
  }

 private:
  bool inside(std::size_t node) const { return grid_.value[node] < 0.0; }

  void cube(std::size_t base) {
    unsigned signs = 0;
    for (unsigned mask = 0; mask < 8; ++mask) signs |= inside(grid_.step(base, mask)) ? 1u << mask : 0u;
    if (signs == 0 || signs == 255) return;
    // Paths from corner 0 to corner 7, one axis at a time; odd permutations swapped so that all turn right.
    static constexpr unsigned paths[6][2] = {{1, 3}, {2, 6}, {4, 5}, {3, 2}, {6, 4}, {5, 1}};
    for (const auto& path : paths) tetrahedron(base, {0, path[0], path[1], 7});
  }

  /// Corners of the tetrahedron as masks; right-handed: (b - a) x (c - a) . (d - a) > 0.
  void tetrahedron(std::size_t base, const std::array<unsigned, 4>& corner) {
    std::array<unsigned, 4> in{}, out{};
    std::size_t n_in = 0, n_out = 0;
    std::array<std::size_t, 4> in_at{}, out_at{};
    for (std::size_t c = 0; c < 4; ++c) {
      if (inside(grid_.step(base, corner[c]))) {
        in_at[n_in] = c;
        in[n_in++] = corner[c];
      } else {
        out_at[n_out] = c;
        out[n_out++] = corner[c];
      }
    }
    const auto v = [&](unsigned a, unsigned b) { return vertex(base, a, b); };
    if (n_in == 1) {
      add(v(in[0], out[0]), v(in[0], out[1]), v(in[0], out[2]), in_at[0] % 2 == 1);
    } else if (n_in == 3) {
      add(v(in[0], out[0]), v(in[1], out[0]), v(in[2], out[0]), out_at[0] % 2 == 0);
    } else if (n_in == 2) {
      // Permutation (in0, in1, out0, out1) of the corners is even or odd.
      const bool odd = (in_at[0] + in_at[1]) % 2 == 0;
      const std::int32_t a = v(in[0], out[0]), b = v(in[0], out[1]), c = v(in[1], out[1]),
                         d = v(in[1], out[0]);
      add(a, b, c, odd);
      add(a, c, d, odd);
    }
  }

  void add(std::int32_t a, std::int32_t b, std::int32_t c, bool swap) {
    if (swap) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  std::int32_t vertex(std::size_t base, unsigned a, unsigned b) {
    const unsigned low = a & b, way = a ^ b;  // one contains the other
    const std::size_t start = grid_.step(base, low);
    const auto [it, fresh] =
        known_.try_emplace(start * 8 + way, static_cast<std::int32_t>(mesh_.vertices.size()));
    if (fresh) mesh_.vertices.push_back(crossing(start, grid_.step(start, way)));
    return it->second;
  }

  /// Point of the edge where the distance is zero (Illinois false position), kept a little off the ends.
  Vec3 crossing(std::size_t node_a, std::size_t node_b) const {
    const Vec3 a = grid_.node(node_a), b = grid_.node(node_b);
    double low = 0.0, high = 1.0, f_low = grid_.value[node_a], f_high = grid_.value[node_b], t = 0.5;
    for (int i = 0; i < 6; ++i) {
      t = (low * f_high - high * f_low) / (f_high - f_low);
      const double f = solid_(a + t * (b - a));
      if (std::abs(f) < 1e-4 * grid_.cell) break;
      if ((f < 0.0) == (f_low < 0.0)) {
        low = t;
        f_low = f;
        f_high *= 0.5;
      } else {
        high = t;
        f_high = f;
        f_low *= 0.5;
      }
    }
    t = std::min(0.97, std::max(0.03, t));
    return a + t * (b - a);
  }

  const Solid& solid_;
  const Grid& grid_;
  TriangleMesh mesh_;
  std::unordered_map<std::size_t, std::int32_t> known_;
};

}  // namespace

TriangleMesh polygonise(const Solid& solid, double cell, const PolygoniseOptions& options) {
  if (!(cell > 0.0) || solid.box.empty()) throw std::logic_error("polygonise: needs a cell > 0 and a box");
  const Grid grid = sample(solid, cell, options.n_threads);
  TriangleMesh mesh = Marcher(solid, grid).run();
  if (mesh.empty()) throw std::logic_error("polygonise: the solid has no surface on this grid");
  relax(mesh, solid, 0.5 * cell, options.relax_iterations, options.n_threads);
  if (options.sharpen) sharpen(mesh, solid, cell, options.n_threads);
  return mesh;
}

}  // namespace eigengrasp::modeling
