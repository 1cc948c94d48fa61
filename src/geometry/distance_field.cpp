// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "eigengrasp/core/parallel.hpp"
#include "geometry/grid_distances.hpp"

namespace eigengrasp {

namespace {

/// The eight values about a point and the weights along the axes.
struct CellView {
  std::array<double, 8> v;  // x fastest
  double fx, fy, fz;
};

CellView look_up(const FieldGrid& grid, const Vec3& p) {
  const double inverse = 1.0 / grid.cell;
  const Vec3 u = (p - grid.origin) * inverse;
  const int ix = std::clamp(static_cast<int>(u.x()), 0, grid.nodes.x() - 2);
  const int iy = std::clamp(static_cast<int>(u.y()), 0, grid.nodes.y() - 2);
  const int iz = std::clamp(static_cast<int>(u.z()), 0, grid.nodes.z() - 2);
  const auto nx = static_cast<std::size_t>(grid.nodes.x());
  const std::size_t nxy = nx * static_cast<std::size_t>(grid.nodes.y());
  const float* c = grid.values.data() + static_cast<std::size_t>(iz) * nxy +
                   static_cast<std::size_t>(iy) * nx + static_cast<std::size_t>(ix);
  return {{c[0], c[1], c[nx], c[nx + 1], c[nxy], c[nxy + 1], c[nxy + nx], c[nxy + nx + 1]},
          u.x() - ix,
          u.y() - iy,
          u.z() - iz};
}

double mix(double a, double b, double t) {
  return a + t * (b - a);
}

FieldGrid make_grid(const Box& surface, double margin, double cell, const Box& region) {
  Box box{surface.min - Vec3::Constant(margin), surface.max + Vec3::Constant(margin)};
  if (!region.empty()) {
    box.min = box.min.cwiseMax(region.min).cwiseMin(region.max);
    box.max = box.max.cwiseMin(region.max).cwiseMax(box.min);
  }
  FieldGrid grid;
  const Vec3 size = box.size();
  // Very large objects get larger cells, so that the grid stays within memory.
  cell = std::max(cell, size.maxCoeff() / 200.0);
  grid.cell = cell;
  grid.nodes = (size / cell).array().ceil().cast<int>() + 1;
  grid.nodes = grid.nodes.cwiseMax(2);
  const Vec3 covered = cell * (grid.nodes.array() - 1).cast<double>().matrix();
  grid.origin = box.center() - 0.5 * covered;
  grid.values.resize(static_cast<std::size_t>(grid.nodes.x()) * static_cast<std::size_t>(grid.nodes.y()) *
                     static_cast<std::size_t>(grid.nodes.z()));
  return grid;
}

Vec3 node_position(const FieldGrid& grid, int x, int y, int z) {
  return grid.origin + grid.cell * Vec3(x, y, z);
}

/// Gives the nodes inside a negative sign. Neighbours whose distances sum to more than the step between them
/// lie on the same side, so that the winding number is needed once for each region of such nodes.
class SignFill {
 public:
  SignFill(const MeshBvh& bvh, FieldGrid& grid, int threads)
      : bvh_(bvh),
        grid_(grid),
        nx_(grid.nodes.x()),
        ny_(grid.nodes.y()),
        nz_(grid.nodes.z()),
        threads_(threads),
        region_(grid.values.size(), none) {}

  void run() {
    for (int z = 0; z < nz_; ++z)
      for (int y = 0; y < ny_; ++y)
        for (int x = 0; x < nx_; ++x)
          if (region_[index(x, y, z)] == none) flood({x, y, z});
    const std::vector<char> inside = insides();
    for (std::size_t i = 0; i < region_.size(); ++i)
      if (inside[static_cast<std::size_t>(region_[i])]) grid_.values[i] = -grid_.values[i];
  }

 private:
  using Place = std::array<int, 3>;
  static constexpr std::int32_t none = -1;
  static constexpr std::size_t seeds_at_a_time = 64;

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }

  /// A new region: all that can be reached from a node without coming near the surface.
  void flood(const Place& seed) {
    const auto region = static_cast<std::int32_t>(seeds_.size());
    seeds_.push_back(seed);
    queue_.assign(1, seed);
    region_[index(seed[0], seed[1], seed[2])] = region;
    while (!queue_.empty()) {
      const Place at = queue_.back();
      queue_.pop_back();
      const float here = grid_.values[index(at[0], at[1], at[2])];
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (int step : {-1, 1}) {
          Place next = at;
          next[axis] += step;
          if (next[axis] < 0 || next[axis] >= grid_.nodes[static_cast<Eigen::Index>(axis)]) continue;
          const std::size_t j = index(next[0], next[1], next[2]);
          if (region_[j] != none || here + grid_.values[j] <= 1.0001 * grid_.cell) continue;
          region_[j] = region;
          queue_.push_back(next);
        }
    }
  }

  /// Of each region, whether it lies inside.
  std::vector<char> insides() const {
    std::vector<char> inside(seeds_.size());
    const std::size_t parts = (seeds_.size() + seeds_at_a_time - 1) / seeds_at_a_time;
    parallel_for(parts, threads_, [&](std::size_t part, int) {
      const std::size_t end = std::min(seeds_.size(), (part + 1) * seeds_at_a_time);
      for (std::size_t i = part * seeds_at_a_time; i < end; ++i)
        inside[i] = bvh_.contains(node_position(grid_, seeds_[i][0], seeds_[i][1], seeds_[i][2]));
    });
    return inside;
  }

  const MeshBvh& bvh_;
  FieldGrid& grid_;
  int nx_, ny_, nz_;
  int threads_;
  std::vector<std::int32_t> region_;  ///< of each node
  std::vector<Place> seeds_;          ///< a node of each region
  std::vector<Place> queue_;
};

}  // namespace

double FieldGrid::value(const Vec3& p) const {
  const CellView c = look_up(*this, p);
  const double y0 = mix(mix(c.v[0], c.v[1], c.fx), mix(c.v[2], c.v[3], c.fx), c.fy);
  const double y1 = mix(mix(c.v[4], c.v[5], c.fx), mix(c.v[6], c.v[7], c.fx), c.fy);
  return mix(y0, y1, c.fz);
}

FieldSample FieldGrid::sample(const Vec3& p) const {
  const CellView c = look_up(*this, p);
  const double x00 = mix(c.v[0], c.v[1], c.fx);
  const double x10 = mix(c.v[2], c.v[3], c.fx);
  const double x01 = mix(c.v[4], c.v[5], c.fx);
  const double x11 = mix(c.v[6], c.v[7], c.fx);
  const double y0 = mix(x00, x10, c.fy);
  const double y1 = mix(x01, x11, c.fy);
  FieldSample s;
  s.distance = mix(y0, y1, c.fz);
  s.gradient.x() =
      mix(mix(c.v[1] - c.v[0], c.v[3] - c.v[2], c.fy), mix(c.v[5] - c.v[4], c.v[7] - c.v[6], c.fy), c.fz);
  s.gradient.y() = mix(x10 - x00, x11 - x01, c.fz);
  s.gradient.z() = y1 - y0;
  s.gradient /= cell;
  return s;
}

const std::shared_ptr<const DistanceField::Grids>& DistanceField::no_grids() {
  static const auto none = std::make_shared<const Grids>();
  return none;
}

DistanceField::DistanceField(const MeshBvh& bvh, const DistanceFieldOptions& options) {
  if (bvh.empty()) return;
  const Box& box = bvh.box();
  const double largest = box.size().maxCoeff();
  const double cell = options.cell > 0.0 ? options.cell : std::clamp(largest / 64.0, 0.001, 0.002);
  auto grids = std::make_shared<Grids>();
  grids->fine = make_grid(box, options.margin, cell, options.region);
  grids->coarse = make_grid(box, options.far_margin, 0.008, options.region);
  for (FieldGrid* grid : {&grids->fine, &grids->coarse}) {
    fill_unsigned_distances(bvh, *grid, options.threads);
    SignFill(bvh, *grid, options.threads).run();
  }
  grids_ = std::move(grids);
}

DistanceField::DistanceField(std::shared_ptr<const Grids> grids) {
  if (grids) grids_ = std::move(grids);
}

DistanceField DistanceField::scaled(double factor) const {
  DistanceField field = *this;
  field.scale_ *= factor;
  field.per_scale_ = 1.0 / field.scale_;
  return field;
}

FieldSample DistanceField::sample(const Vec3& p) const {
  FieldSample s = sample_unscaled(p * per_scale_);
  s.distance *= scale_;
  return s;
}

FieldSample DistanceField::sample_unscaled(const Vec3& p) const {
  const FieldGrid& coarse_grid = coarse();
  if (fine().contains(p)) return fine().sample(p);
  if (coarse_grid.contains(p)) return coarse_grid.sample(p);
  const Box box = coarse_grid.box();
  const Vec3 q = p.cwiseMax(box.min).cwiseMin(box.max);
  const FieldSample at_border = coarse_grid.sample(q);
  const Vec3 nearest = q - at_border.distance * at_border.gradient.normalized();
  FieldSample s;
  s.distance = (p - nearest).norm();
  s.gradient = (p - nearest) / s.distance;
  return s;
}

double DistanceField::distance(const Vec3& p_scaled) const {
  const Vec3 p = p_scaled * per_scale_;
  if (fine().contains(p)) return scale_ * fine().value(p);
  if (coarse().contains(p)) return scale_ * coarse().value(p);
  return scale_ * sample_unscaled(p).distance;
}

}  // namespace eigengrasp
